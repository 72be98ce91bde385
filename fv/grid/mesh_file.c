/* mesh_file.c - see mesh_file.h. Plot3D: [number of blocks,] ni nj [nk] of each, then x of all
 * vertices, y, [z] of each block, as text, as a stream of 4-byte integers and 8- or 4-byte reals,
 * or the same in Fortran's records; which of these is told by the length of the file.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_file.h"

#include <ctype.h>
#include <errno.h>
#include <hdf5.h>
#include <unistd.h>

/* Dataset "x" of shape [nk][nj][ni][dim]; NULL without errors printed if the file has no such
 * thing. */
static double *read_hdf5(const char *path, int dim, int *cells)
{
    hsize_t shape[4] = {0};
    double *x = NULL;
    hid_t file = -1, set = -1, space = -1;
    H5E_BEGIN_TRY
    {
        file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
        set = file < 0 ? -1 : H5Dopen2(file, "x", H5P_DEFAULT);
        space = set < 0 ? -1 : H5Dget_space(set);
        if (space >= 0 && H5Sget_simple_extent_ndims(space) == dim + 1 &&
            H5Sget_simple_extent_dims(space, shape, NULL) > 0 && shape[dim] == (hsize_t)dim) {
            int64_t n = dim;
            for (int a = 0; a < dim; a++) {
                cells[a] = (int)shape[dim - 1 - a] - 1;
                n *= cells[a] + 1;
            }
            x = NEW(double, n);
            if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, x) < 0) {
                mem_free(x);
                x = NULL;
            }
        }
        if (space >= 0)
            H5Sclose(space);
        if (set >= 0)
            H5Dclose(set);
        if (file >= 0)
            H5Fclose(file);
    }
    H5E_END_TRY
    return x;
}

/* A file's numbers as one list: of text all of them, of binary files the leading ones as integers,
 * for the header. */
struct numbers {
    int64_t n;
    double *v;
};

/* Numbers separated by space or commas, up to the first thing that is none. */
static struct numbers read_text(const char *bytes)
{
    struct numbers s = {0};
    int64_t room = 0;
    char *end;
    for (const char *at = bytes;; at = end) {
        const double v = strtod(at, &end);
        if (end == at)
            return s;
        if (s.n == room)
            GROW(s.v, s.n, room = 2 * room + 1024);
        s.v[s.n++] = v;
        while (isspace((unsigned char)*end) || *end == ',')
            end++;
    }
}

static int int_at(const char *bytes, int64_t at)
{
    int32_t v;
    memcpy(&v, bytes + at, 4);
    return v;
}

/* Takes Fortran's record marks out; false: there are none. A record is its length in bytes, the
 * data, the length again, all 4-byte integers. Pass 0 checks, pass 1 moves the data together. */
static bool join_records(char *bytes, int64_t *n)
{
    int64_t from = 0, to = 0;
    for (int pass = 0; pass < 2; pass++)
        for (from = to = 0; from < *n;) {
            const int64_t m = *n - from >= 8 ? int_at(bytes, from) : -1;
            if (pass == 0 && (m < 0 || from + m + 8 > *n || int_at(bytes, from + 4 + m) != m))
                return false;
            if (pass == 1 && m > 0)
                memmove(bytes + to, bytes + from + 4, m > 0 ? (size_t)m : 0);
            to += m;
            from += m + 8;
        }
    *n = to;
    return true;
}

/* Tries header and sizes against the length: nb blocks (0: no count), axes in the header. Returns
 * the number of vertices in the blocks before `zone', or -1 if header and shape make no sense;
 * *all: of all blocks; *header: numbers in the header; shape: that of the zone. */
static int64_t vertices_before(const double *head, int64_t nhead, bool counted, int axes, int zone,
                               int *shape, int64_t *all, int64_t *header)
{
    const int nb = counted ? (nhead > 0 ? (int)head[0] : 0) : 1;
    int64_t before = 0;
    *all = 0;
    *header = counted + (int64_t)nb * axes;
    if (nb < 1 || nb > 10000 || *header > nhead || zone > nb)
        return -1;
    for (int b = 0; b < nb; b++) {
        int64_t n = 1;
        for (int a = 0; a < axes; a++) {
            const double m = head[counted + b * axes + a];
            if (!(m >= 1.0 && m < 1e7))
                return -1;
            n *= (int64_t)m;
            if (b == zone - 1)
                shape[a] = (int)m;
        }
        if (b < zone - 1)
            before += n;
        *all += n;
    }
    return before;
}

/* The k-th real of 4 or 8 bytes, in the machine's byte order. */
static double real_at(const char *bytes, int64_t k, int size)
{
    double v;
    float s;
    if (size == 8) {
        memcpy(&v, bytes + 8 * k, 8);
        return v;
    }
    memcpy(&s, bytes + 4 * k, 4);
    return s;
}

/* Tries one form: size is the bytes of a real (0: text in `s'), counted whether the header begins
 * with the number of blocks, axes how many sizes each has. NULL unless the file's length is exactly
 * that of this form. */
static double *try_form(const struct numbers *s, const char *bytes, int64_t n, int size,
                        bool counted, int axes, int zone, int dim, int *cells)
{
    int shape[3] = {1, 1, 1};
    int64_t all, header;
    const int64_t before = vertices_before(s->v, s->n, counted, axes, zone, shape, &all, &header);
    if (before < 0 || (dim == 2 && shape[2] != 1) || (dim == 3 && axes == 2))
        return NULL;
    if (size == 0 ? s->n != header + all * axes : n != 4 * header + size * all * axes)
        return NULL;
    const int64_t m = (int64_t)shape[0] * shape[1] * shape[2];
    double *x = NEW(double, m *dim);
    for (int c = 0; c < dim; c++)
        for (int64_t k = 0; k < m; k++) {
            const int64_t at = before * axes + c * m + k;
            x[dim * k + c] = size ? real_at(bytes + 4 * header, at, size) : s->v[header + at];
        }
    for (int a = 0; a < dim; a++)
        cells[a] = shape[a] - 1;
    return x;
}

/* The eight forms by their bits: size of reals, no count, three axes in 2D. The length of the file
 * decides, so that at most one fits in practice. */
static double *try_forms(const struct numbers *s, const char *bytes, int64_t n, bool text, int zone,
                         int dim, int *cells)
{
    for (int k = 0; k < 8; k++) {
        const int size = text ? 0 : k & 1 ? 4 : 8;
        double *x = try_form(s, bytes, n, size, !(k & 2), k & 4 ? 3 : dim, zone, dim, cells);
        if (x)
            return x;
    }
    return NULL;
}

/* Text if the first 200 bytes are printable. 30001 leading integers suffice for 10000 blocks. */
static double *read_plot3d(const char *path, int zone, int dim, int *cells)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    fseek(file, 0, SEEK_END);
    int64_t n = ftell(file);
    rewind(file);
    char *bytes = NEW(char, n + 1);
    n = (int64_t)fread(bytes, 1, (size_t)n, file);
    fclose(file);
    bool text = true;
    for (int64_t k = 0; k < n && k < 200; k++)
        text = text && (isprint((unsigned char)bytes[k]) || isspace((unsigned char)bytes[k]));
    struct numbers s = {0};
    if (text)
        s = read_text(bytes);
    else {
        join_records(bytes, &n);
        s.n = n / 4 < 30001 ? n / 4 : 30001;
        s.v = NEW(double, s.n);
        for (int64_t k = 0; k < s.n; k++)
            s.v[k] = int_at(bytes, 4 * k);
    }
    double *x = try_forms(&s, bytes, n, text, zone, dim, cells);
    FREE(s.v, bytes);
    return x;
}

/* Six cells along each index are what cubic maps and stencils need. */
double *mesh_file_read(const struct run *r, struct faults *f, const struct mesh_block_params *p,
                       int *cells)
{
    const int dim = r->scene.domain.dim;
    const char *path = case_path(r->case_dir, p->file);
    double *x = NULL;
    int good = 0;
    if (r->rank == 0) {
        const size_t m = strlen(p->file);
        x = m > 3 && strcmp(p->file + m - 3, ".h5") == 0 ? read_hdf5(path, dim, cells)
                                                         : read_plot3d(path, p->zone, dim, cells);
        good = x ? 1 : access(path, R_OK) ? -errno : 0;
    }
    MPI_Bcast(&good, 1, MPI_INT, 0, r->comm);
    MPI_Bcast(cells, 3, MPI_INT, 0, r->comm);
    if (good < 0) {
        mesh_fault(r, f, p, "file", "%s cannot be read: %s", path, strerror(-good));
        return NULL;
    }
    if (!good) {
        mesh_fault(r, f, p, "file",
                   "%s holds no vertices of %dD blocks (HDF5: dataset x[k][j][i][%d]; else Plot3D "
                   "with a zone %d)",
                   path, dim, dim, p->zone);
        return NULL;
    }
    int64_t n = dim;
    for (int a = 0; a < dim; a++) {
        n *= cells[a] + 1;
        if (cells[a] < 6) {
            mesh_fault(r, f, p, "file", "%d cells along %c: at least 6 are needed", cells[a],
                       "ijk"[a]);
            mem_free(x);
            return NULL;
        }
    }
    if (r->rank > 0)
        x = NEW(double, n);
    MPI_Bcast(x, (int)n, MPI_DOUBLE, 0, r->comm);
    return x;
}
