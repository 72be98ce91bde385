/* test_h5_block.c - blocks of cells are put together whatever the ranks, x fastest; attributes; a
 * file that is being written goes by another name. ranks: 1 2 4.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <hdf5.h>
#include <unistd.h>

#include "../../../common/base/ranks.h"
#include "../../../common/files/h5.h"

static const char *path;
static char part[520];
static int rank, size;

static bool all(bool good) { return ranks_all(MPI_COMM_WORLD, good); }

/* Cells 5 x 4 (x 3), two components: the ranks but the last have slabs in y, the last of several
 * none. Read back as rows by rank 0 alone. */
TEST(blocks_make_one_dataset)
{
    const int cells[3] = {5, 4, 3}, givers = size > 1 ? size - 1 : 1;
    for (int dim = 2; dim <= 3; dim++)
        for (int ncomp = 1; ncomp <= 2; ncomp++) {
            int lo[3] = {0, 4 * rank / givers, 0},
                hi[3] = {5, 4 * (rank + 1) / givers, dim == 3 ? 3 : 1};
            double v[120], whole[120];
            int n = 0;
            if (rank >= givers)
                lo[1] = hi[1] = 4;
            for (int k = lo[2]; k < hi[2]; k++)
                for (int j = lo[1]; j < hi[1]; j++)
                    for (int i = lo[0]; i < hi[0]; i++)
                        for (int c = 0; c < ncomp; c++)
                            v[n++] = i + 10 * j + 100 * k + 1000 * c;
            struct h5 *f = h5_create(MPI_COMM_WORLD, path);
            h5_write_block(f, "block", "m", dim, cells, lo, hi, ncomp, v, false);
            h5_close(&f);
            const int count = 5 * 4 * (dim == 3 ? 3 : 1);
            bool good = true;
            if (rank == 0) {
                const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
                const hid_t set = H5Dopen2(file, "block", H5P_DEFAULT), space = H5Dget_space(set);
                hsize_t shape[4] = {0};
                good = H5Sget_simple_extent_ndims(space) == dim + (ncomp > 1);
                H5Sget_simple_extent_dims(space, shape, NULL);
                for (int a = 0; a < dim; a++)
                    good = good && shape[dim - 1 - a] == (hsize_t)cells[a];
                good = good && (ncomp == 1 || shape[dim] == 2);
                if (good)
                    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, whole);
                for (int m = 0; good && m < count * ncomp; m++) {
                    const int cell = m / ncomp;
                    good = whole[m] ==
                           cell % 5 + 10 * (cell / 5 % 4) + 100 * (cell / 20) + 1000 * (m % ncomp);
                }
                H5Sclose(space);
                H5Dclose(set);
                H5Fclose(file);
            }
            assert_true(all(good));
        }
}

TEST(attributes_come_back)
{
    double t = 0.0;
    int64_t step = 0;
    struct h5 *f = h5_create(MPI_COMM_WORLD, path);
    h5_attribute_real(f, "time", 1.0 / 3.0);
    h5_attribute_int(f, "step", -((int64_t)1 << 60) + 1);
    h5_attribute_text(f, "case", "two\nlines, ü");
    h5_close(&f);
    f = h5_open(MPI_COMM_WORLD, path);
    assert_true(all(h5_read_attribute_real(f, "time", &t) && t == 1.0 / 3.0));
    assert_true(all(h5_read_attribute_int(f, "step", &step) && step == -((int64_t)1 << 60) + 1));
    assert_true(all(!h5_read_attribute_real(f, "none", &t) && t == 1.0 / 3.0));
    h5_close(&f);
    char text[32] = "";
    if (rank == 0) {
        const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT),
                    a = H5Aopen(file, "case", H5P_DEFAULT);
        const hid_t type = H5Aget_type(a);
        H5Aread(a, type, text);
        H5Tclose(type);
        H5Aclose(a);
        H5Fclose(file);
    }
    assert_true(all(rank > 0 || strcmp(text, "two\nlines, ü") == 0));
}

TEST(a_file_under_its_name_is_complete)
{
    int64_t n = 0;
    struct h5 *f = h5_create(MPI_COMM_WORLD, path);
    h5_attribute_int(f, "which", 1);
    h5_close(&f);
    f = h5_create(MPI_COMM_WORLD, path);
    h5_attribute_int(f, "which", 2);
    assert_true(all(access(part, F_OK) == 0));
    struct h5 *old = h5_open(MPI_COMM_WORLD, path); /* the old one, until the new one is closed */
    assert_true(all(h5_read_attribute_int(old, "which", &n) && n == 1));
    h5_close(&old);
    h5_close(&f);
    assert_true(all(access(part, F_OK) != 0));
    f = h5_open(MPI_COMM_WORLD, path);
    assert_true(all(h5_read_attribute_int(f, "which", &n) && n == 2));
    h5_close(&f);
}

void unit_begin(void)
{
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    path = unit_file("file.h5");
    snprintf(part, sizeof part, "%s.part", path);
}
