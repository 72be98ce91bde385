/* test_h5.c - files written by all ranks hold what was given, in the order of the ranks, and a file
 * under its name is complete. ranks: 1 2 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <hdf5.h>

#include "../../../common/base/ranks.h"
#include "../../../common/files/h5.h"

enum { MOST = 16 };

static const char *path;
static int rank, size;

/* Row i of all, component k. */
static double value(int64_t i, int k) { return 0.1 * (double)i + 1000.0 * k + 1.0 / 3.0; }

/* 3 rows on rank 0, none on rank 1, then 5, 6: rows before this rank, and of it. */
static int64_t rows(int64_t *first)
{
    static const int64_t of[4] = {3, 0, 5, 6};
    *first = 0;
    for (int r = 0; r < rank; r++)
        *first += of[r % 4];
    return of[rank % 4];
}

/* The same answer on all ranks: true if it is true on every one. */
static bool all(bool good) { return ranks_all(MPI_COMM_WORLD, good); }

static void write_rows(struct h5 *f, int ncomp, bool single)
{
    double v[3 * MOST];
    int64_t first, n = rows(&first), id[MOST];
    for (int64_t i = 0; i < n; i++) {
        id[i] = 7 * (first + i) - ((int64_t)1 << 40);
        for (int k = 0; k < ncomp; k++)
            v[i * ncomp + k] = value(first + i, k);
    }
    h5_write_real(f, "velocity", "m/s", n, ncomp, n ? v : NULL, single);
    h5_write_int(f, "id", n, n ? id : NULL);
}

static bool read_rows(int ncomp, double tolerance)
{
    struct h5 *f = h5_open(MPI_COMM_WORLD, path);
    double v[3 * MOST];
    int64_t first, n = rows(&first), id[MOST];
    bool good = f && h5_read_real(f, "velocity", n, ncomp, n ? v : NULL) &&
                h5_read_int(f, "id", n, n ? id : NULL);
    for (int64_t i = 0; good && i < n; i++) {
        good = id[i] == 7 * (first + i) - ((int64_t)1 << 40);
        for (int k = 0; k < ncomp; k++)
            good = good && fabs(v[i * ncomp + k] - value(first + i, k)) <=
                               tolerance * fabs(value(first + i, k));
    }
    h5_close(&f);
    return all(good);
}

TEST(rows_come_back_bit_for_bit)
{
    for (int ncomp = 1; ncomp <= 3; ncomp++) {
        struct h5 *f = h5_create(MPI_COMM_WORLD, path);
        write_rows(f, ncomp, false);
        h5_close(&f);
        assert_null(f);
        assert_true(read_rows(ncomp, 0.0));
    }
}

TEST(single_storage_keeps_24_bits)
{
    struct h5 *f = h5_create(MPI_COMM_WORLD, path);
    write_rows(f, 2, true);
    h5_close(&f);
    assert_true(read_rows(2, 0x1p-24));
    assert_false(read_rows(2, 0x1p-30)); /* it is not stored as double */
}

/* Rank 0 looks with HDF5 alone: order of the rows, shape and unit. */
TEST(shape_order_and_unit_are_what_readers_expect)
{
    struct h5 *f = h5_create(MPI_COMM_WORLD, path);
    write_rows(f, 2, false);
    h5_close(&f);
    bool good = true;
    if (rank == 0) {
        double v[2 * 4 * MOST];
        hsize_t shape[2] = {0};
        char unit[16] = "";
        const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT),
                    set = H5Dopen2(file, "velocity", H5P_DEFAULT);
        const hid_t space = H5Dget_space(set), a = H5Aopen(set, "units", H5P_DEFAULT),
                    type = H5Aget_type(a);
        good = H5Sget_simple_extent_ndims(space) == 2;
        H5Sget_simple_extent_dims(space, shape, NULL);
        H5Aread(a, type, unit);
        H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, v);
        good = good && shape[1] == 2 && strcmp(unit, "m/s") == 0;
        for (hsize_t i = 0; good && i < shape[0]; i++)
            good = v[2 * i] == value((int64_t)i, 0) && v[2 * i + 1] == value((int64_t)i, 1);
        int64_t wanted = 0;
        for (int r = 0; r < size; r++)
            wanted += (int64_t[]){3, 0, 5, 6}[r % 4];
        good = good && (int64_t)shape[0] == wanted;
        H5Tclose(type);
        H5Aclose(a);
        H5Sclose(space);
        H5Dclose(set);
        H5Fclose(file);
    }
    assert_true(all(good));
}

TEST(restart_files_know_the_rows_of_each_rank)
{
    int64_t first;
    const int64_t n = rows(&first);
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    write_rows(f, 3, false);
    h5_close(&f);
    f = h5_open(MPI_COMM_WORLD, path);
    assert_true(all(h5_rows(f, "velocity") == n && h5_rows(f, "id") == n));
    assert_true(all(h5_rows(f, "nothing") == -1));
    h5_close(&f);
    assert_true(read_rows(3, 0.0));
    f = h5_open(MPI_COMM_SELF, path); /* another number of ranks */
    assert_true(all(h5_rows(f, "id") == (size == 1 ? n : -1)));
    h5_close(&f);
    MPI_Barrier(MPI_COMM_WORLD);
}

TEST(what_does_not_fit_is_refused)
{
    double v[3 * (MOST + 1)];
    int64_t first;
    const int64_t n = rows(&first);
    struct h5 *f = h5_create(MPI_COMM_WORLD, path);
    write_rows(f, 2, false);
    h5_close(&f);
    f = h5_open(MPI_COMM_WORLD, path);
    assert_true(all(!h5_read_real(f, "nothing", n, 2, v)));
    assert_true(all(!h5_read_real(f, "velocity", n, 3, v)));
    assert_true(all(!h5_read_real(f, "velocity", n, 1, v)));
    assert_true(all(!h5_read_real(f, "velocity", n + 1, 2, v)));
    assert_true(all(h5_read_real(f, "velocity", n, 2, v)));
    h5_close(&f);
    assert_null(h5_open(MPI_COMM_WORLD, "no/such file.h5"));
    if (rank == 0) {
        FILE *t = fopen(path, "w");
        fclose(t); /* empty */
    }
    MPI_Barrier(MPI_COMM_WORLD);
    assert_null(h5_open(MPI_COMM_WORLD, path));
}

TEST(no_rows_at_all_are_legal)
{
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    h5_write_real(f, "empty", "m", 0, 2, NULL, false);
    h5_close(&f);
    f = h5_open(MPI_COMM_WORLD, path);
    assert_true(all(h5_rows(f, "empty") == 0 && h5_read_real(f, "empty", 0, 2, NULL)));
    h5_close(&f);
}

/* Ranks that did not write it: shares cover all rows once, any range comes back, parts of a sum are
 * summed, what all hold alike is not. */
TEST(other_ranks_read_it_too)
{
    int64_t first, wanted = 0, n;
    double part[2] = {1.0 + rank, 7.0}, same[2];
    (void)rows(&first);
    for (int r = 0; r < size; r++)
        wanted += (int64_t[]){3, 0, 5, 6}[r % 4];
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    write_rows(f, 2, false);
    h5_write_real(f, "part", "-", 2, 1, part, false);
    h5_close(&f);
    f = h5_open(MPI_COMM_SELF, path);
    bool good = h5_ranks(f) == size && h5_share(f, "id") == wanted && h5_share(f, "none") == -1;
    double *v = h5_read_all_real(f, "velocity", 2, &n);
    good = good && v && n == wanted;
    for (int64_t i = 0; good && i < n; i++)
        good = v[2 * i] == value(i, 0) && v[2 * i + 1] == value(i, 1);
    mem_free(v);
    int64_t *starts = h5_first_rows(f, "id");
    double at[4];
    good = good && starts && starts[0] == 0 && starts[size] == wanted && starts[rank] == first &&
           h5_read_real_at(f, "velocity", 1, 2, 2, at) && at[2] == value(2, 0) &&
           !h5_read_real_at(f, "velocity", wanted, 2, 2, at);
    mem_free(starts);
    good = good && h5_read_same(f, "part", 2, same) && same[0] == 1.0 && same[1] == 7.0;
    good = good && h5_read_parts(f, "part", 2, part) && part[0] == 0.5 * size * (size + 1) &&
           part[1] == 7.0 * size;
    h5_close(&f);
    assert_true(all(good));
}

/* One rank wrote it, all read it: even shares in the order of the ranks. */
TEST(shares_are_even)
{
    enum { ROWS = 10 };
    double v[ROWS];
    struct h5 *f = NULL;
    for (int i = 0; i < ROWS; i++)
        v[i] = value(i, 0);
    if (rank == 0) {
        f = h5_create_restart(MPI_COMM_SELF, path);
        h5_write_real(f, "x", "m", ROWS, 1, v, false);
        h5_close(&f);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    f = h5_open(MPI_COMM_WORLD, path);
    const int64_t n = h5_share(f, "x");
    int64_t first = 0, sum = n;
    MPI_Exscan(&n, &first, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    first = rank > 0 ? first : 0;
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    bool good = sum == ROWS && n >= ROWS / size && n <= ROWS / size + 1;
    good = h5_read_real(f, "x", n, 1, v) && good;
    for (int64_t i = 0; good && i < n; i++)
        good = v[i] == value(first + i, 0);
    h5_close(&f);
    assert_true(all(good));
}

void unit_begin(void)
{
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    path = unit_file("file.h5");
}
