/* h5.c - see h5.h. Any failure of the library ends the run: a restart file that cannot be written
 * must not be missed. Every dataset is a list of records (rows) or a block of cells; each rank
 * selects its part of the file (a hyperslab of struct h5_part) and one collective transfer moves
 * all parts at once. So every rank must come to every call, with an empty selection where it has
 * nothing.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "h5.h"

#include <errno.h>
#include <hdf5.h>
#include <unistd.h>

#include "../base/base.h"
#include "disk.h"

struct h5 {
    MPI_Comm comm;
    int rank, size;
    hid_t file, transfer;
    bool writing, restart;
    int ranks; /* that wrote it */
    char path[1100], part[1110];
};

/* Where the library fails to write, the disk is to blame. */
#define H5(call)                                                                                   \
    do {                                                                                           \
        if ((call) < 0) {                                                                          \
            if (f->writing) {                                                                      \
                errno = EIO; /* the library keeps the system's to itself */                        \
                disk_failed(f->part);                                                              \
            }                                                                                      \
            abort_run("HDF5: %s failed on %s", #call, f->path);                                    \
        }                                                                                          \
    } while (0)

/* What writing and reading have in common. Transfers are collective: MPI-IO may then gather the
 * ranks' parts into large pieces. */
static struct h5 *start(MPI_Comm comm, const char *path)
{
    struct h5 *f = NEW(struct h5, 1);
    f->comm = comm;
    MPI_Comm_rank(comm, &f->rank);
    MPI_Comm_size(comm, &f->size);
    snprintf(f->path, sizeof f->path, "%s", path);
    snprintf(f->part, sizeof f->part, "%s.part", f->path);
    H5(f->transfer = H5Pcreate(H5P_DATASET_XFER));
    H5(H5Pset_dxpl_mpio(f->transfer, H5FD_MPIO_COLLECTIVE));
    return f;
}

static hid_t access_list(struct h5 *f)
{
    hid_t access;
    H5(access = H5Pcreate(H5P_FILE_ACCESS));
    H5(H5Pset_fapl_mpio(access, f->comm, MPI_INFO_NULL));
    return access;
}

struct h5 *h5_create(MPI_Comm comm, const char *path)
{
    struct h5 *f = start(comm, path);
    const hid_t access = access_list(f);
    f->writing = true;
    H5(H5Eset_auto2(H5E_DEFAULT, NULL, NULL)); /* disk_failed says it in one sentence */
    H5(f->file = H5Fcreate(f->part, H5F_ACC_TRUNC, H5P_DEFAULT, access));
    H5(H5Pclose(access));
    return f;
}

struct h5 *h5_create_restart(MPI_Comm comm, const char *path)
{
    struct h5 *f = h5_create(comm, path);
    f->restart = true;
    f->ranks = f->size;
    h5_attribute_int(f, "ranks", f->ranks);
    return f;
}

/* Rank 0 tries the file first, with the library's own error output off, so that a missing or
 * foreign file is an answer rather than an abort inside a collective open. */
struct h5 *h5_open(MPI_Comm comm, const char *path)
{
    struct h5 *f = start(comm, path);
    int good = 0;
    if (f->rank == 0 && access(path, R_OK) == 0)
        H5E_BEGIN_TRY good = H5Fis_hdf5(path) > 0;
    H5E_END_TRY
    MPI_Bcast(&good, 1, MPI_INT, 0, comm);
    if (!good) {
        H5(H5Pclose(f->transfer));
        mem_free(f);
        return NULL;
    }
    const hid_t access = access_list(f);
    H5(f->file = H5Fopen(path, H5F_ACC_RDONLY, access));
    H5(H5Pclose(access));
    int64_t ranks = 0;
    h5_read_attribute_int(f, "ranks", &ranks);
    f->ranks = (int)ranks;
    return f;
}

/* A file gets its own name only when it is complete on the disk: first all ranks have closed it
 * (the first barrier), then rank 0 seals and renames it, and no rank goes on before that (the
 * second). */
void h5_close(struct h5 **file)
{
    struct h5 *f = *file;
    if (!f)
        return;
    H5(H5Pclose(f->transfer));
    H5(H5Fclose(f->file));
    MPI_Barrier(f->comm);
    if (f->writing && f->rank == 0 &&
        ((f->restart && !disk_seal(f->part)) || rename(f->part, f->path) != 0))
        disk_failed(f->path);
    MPI_Barrier(f->comm);
    mem_free(f);
    *file = NULL;
}

const char *h5_path(const struct h5 *f) { return f->path; }
int h5_ranks(const struct h5 *f) { return f->ranks; }

/* --- attributes --- */

static void write_attribute(struct h5 *f, hid_t of, const char *name, hid_t type, const void *value)
{
    hid_t space, a;
    H5(space = H5Screate(H5S_SCALAR));
    H5(a = H5Acreate2(of, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
    H5(H5Awrite(a, type, value));
    H5(H5Aclose(a));
    H5(H5Sclose(space));
}

static void write_text(struct h5 *f, hid_t of, const char *name, const char *value)
{
    hid_t type;
    H5(type = H5Tcopy(H5T_C_S1));
    H5(H5Tset_size(type, strlen(value) + 1));
    write_attribute(f, of, name, type, value);
    H5(H5Tclose(type));
}

void h5_attribute_real(struct h5 *f, const char *name, double value)
{
    write_attribute(f, f->file, name, H5T_NATIVE_DOUBLE, &value);
}

void h5_attribute_int(struct h5 *f, const char *name, int64_t value)
{
    write_attribute(f, f->file, name, H5T_NATIVE_INT64, &value);
}

void h5_attribute_text(struct h5 *f, const char *name, const char *value)
{
    write_text(f, f->file, name, value);
}

static bool read_attribute(struct h5 *f, const char *name, hid_t type, void *value)
{
    hid_t a;
    if (H5Aexists(f->file, name) <= 0)
        return false;
    H5(a = H5Aopen(f->file, name, H5P_DEFAULT));
    H5(H5Aread(a, type, value));
    H5(H5Aclose(a));
    return true;
}

bool h5_read_attribute_real(struct h5 *f, const char *name, double *value)
{
    return read_attribute(f, name, H5T_NATIVE_DOUBLE, value);
}

bool h5_read_attribute_int(struct h5 *f, const char *name, int64_t *value)
{
    return read_attribute(f, name, H5T_NATIVE_INT64, value);
}

char *h5_read_attribute_text(struct h5 *f, const char *name)
{
    hid_t a, type;
    if (H5Aexists(f->file, name) <= 0)
        return NULL;
    H5(a = H5Aopen(f->file, name, H5P_DEFAULT));
    H5(type = H5Aget_type(a));
    char *text = mem_new(H5Tget_size(type) + 1, 1);
    H5(H5Aread(a, type, text));
    H5(H5Tclose(type));
    H5(H5Aclose(a));
    return text;
}

/* --- datasets --- */

/* Where a rank's part lies in a dataset of `rank' indices (HDF5's word for their number), the first
 * index varying slowest: shape of the whole, first element and count of this rank's, in records or
 * cells. empty: this rank takes part without elements. */
struct h5_part {
    int rank;
    hsize_t shape[4], first[4], count[4];
    bool empty;
};

/* One collective read or write of a part, v holding it without gaps. The library wants a pointer
 * that is not NULL even where nothing is selected. */
static void transfer(struct h5 *f, hid_t set, const struct h5_part *p, hid_t type, void *v,
                     bool write)
{
    hid_t space, memory;
    double nothing = 0.0;
    H5(space = H5Dget_space(set));
    H5(memory = H5Screate_simple(p->rank, p->count, NULL));
    if (p->empty) {
        H5(H5Sselect_none(space));
        H5(H5Sselect_none(memory));
    } else {
        H5(H5Sselect_hyperslab(space, H5S_SELECT_SET, p->first, NULL, p->count, NULL));
    }
    void *at = v ? v : &nothing;
    if (write)
        H5(H5Dwrite(set, type, memory, space, f->transfer, at));
    else
        H5(H5Dread(set, type, memory, space, f->transfer, at));
    H5(H5Sclose(memory));
    H5(H5Sclose(space));
}

/* Makes the dataset on all ranks alike, asks for the room of all of it (not of this rank's part:
 * all answer alike), then writes. A dataset without elements is made, but not written. */
static void write_part(struct h5 *f, const char *name, const char *unit, const struct h5_part *p,
                       hid_t stored, hid_t type, const void *v)
{
    hid_t space, set;
    H5(space = H5Screate_simple(p->rank, p->shape, NULL));
    H5(set = H5Dcreate2(f->file, name, stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    if (unit)
        write_text(f, set, "units", unit);
    bool any = true;
    double bytes = (double)H5Tget_size(stored);
    for (int k = 0; k < p->rank; k++) {
        any = any && p->shape[k] > 0;
        bytes *= (double)p->shape[k];
    }
    disk_room(f->part, bytes);
    if (any)
        transfer(f, set, p, type, (void *)(uintptr_t)v, true);
    H5(H5Dclose(set));
    H5(H5Sclose(space));
}

/* Rows of this rank behind those of the lower ranks. `first' is undefined on rank 0 after
 * MPI_Exscan. */
static struct h5_part rows_part(const struct h5 *f, int64_t n, int ncomp)
{
    int64_t first = 0;
    MPI_Exscan(&n, &first, 1, MPI_INT64_T, MPI_SUM, f->comm);
    if (f->rank == 0)
        first = 0;
    struct h5_part p = {.rank = ncomp > 1 ? 2 : 1, .empty = n == 0};
    p.shape[0] = (hsize_t)ranks_count(f->comm, n);
    p.first[0] = (hsize_t)first;
    p.count[0] = (hsize_t)n;
    p.shape[1] = p.count[1] = (hsize_t)ncomp;
    return p;
}

/* In a restart file: how many records each rank wrote, one number a rank. */
static void write_rows(struct h5 *f, const char *name, int64_t n)
{
    if (!f->restart)
        return;
    const struct h5_part p = rows_part(f, 1, 1);
    write_part(f, key_text("%s_rows", name), NULL, &p, H5T_NATIVE_INT64, H5T_NATIVE_INT64, &n);
}

void h5_write_real(struct h5 *f, const char *name, const char *unit, int64_t n, int ncomp,
                   const double *v, bool single)
{
    const struct h5_part p = rows_part(f, n, ncomp);
    write_part(f, name, unit, &p, single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, v);
    write_rows(f, name, n);
}

void h5_write_int(struct h5 *f, const char *name, int64_t n, const int64_t *v)
{
    const struct h5_part p = rows_part(f, n, 1);
    write_part(f, name, NULL, &p, H5T_STD_I64LE, H5T_NATIVE_INT64, v);
    write_rows(f, name, n);
}

/* Axes turn round: cells are stored with x fastest, so axis a becomes index dim - 1 - a, and
 * components come last. */
void h5_write_block(struct h5 *f, const char *name, const char *unit, int dim, const int *cells,
                    const int *lo, const int *hi, int ncomp, const double *v, bool single)
{
    struct h5_part p = {.rank = dim + (ncomp > 1)};
    for (int a = 0; a < dim; a++) {
        const int k = dim - 1 - a;
        p.shape[k] = (hsize_t)cells[a];
        p.first[k] = (hsize_t)lo[a];
        p.count[k] = (hsize_t)(hi[a] - lo[a]);
        p.empty = p.empty || hi[a] <= lo[a];
    }
    if (ncomp > 1)
        p.shape[dim] = p.count[dim] = (hsize_t)ncomp;
    write_part(f, name, unit, &p, single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, v);
}

/* Rank of a dataset and its shape; 0: there is no such dataset. */
static int shape_of(struct h5 *f, const char *name, hsize_t shape[4])
{
    hid_t set, space;
    memset(shape, 0, 4 * sizeof *shape);
    if (H5Lexists(f->file, name, H5P_DEFAULT) <= 0)
        return 0;
    H5(set = H5Dopen2(f->file, name, H5P_DEFAULT));
    H5(space = H5Dget_space(set));
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank > 0 && rank <= 4)
        H5Sget_simple_extent_dims(space, shape, NULL);
    H5(H5Sclose(space));
    H5(H5Dclose(set));
    return rank <= 4 ? rank : 0;
}

/* False where rank or shape of the dataset are not those of p. All ranks compare the same numbers,
 * since p->shape holds sums over the ranks, so all skip the transfer or none does. */
static bool read_rows(struct h5 *f, const char *name, const struct h5_part *p, hid_t type, void *v)
{
    hid_t set;
    hsize_t shape[4];
    bool fits = shape_of(f, name, shape) == p->rank;
    for (int k = 0; fits && k < p->rank; k++)
        fits = shape[k] == p->shape[k];
    if (!fits || p->shape[0] == 0)
        return fits;
    H5(set = H5Dopen2(f->file, name, H5P_DEFAULT));
    transfer(f, set, p, type, v, false);
    H5(H5Dclose(set));
    return true;
}

int64_t h5_rows(struct h5 *f, const char *name)
{
    int64_t n = 0;
    const struct h5_part p = rows_part(f, 1, 1);
    return read_rows(f, key_text("%s_rows", name), &p, H5T_NATIVE_INT64, &n) ? n : -1;
}

/* An equal share is [n r/size, n (r + 1)/size) in whole numbers: the shares of all ranks add up to
 * n. */
int64_t h5_share(struct h5 *f, const char *name)
{
    hsize_t shape[4];
    if (f->ranks == 0 || f->ranks == f->size)
        return h5_rows(f, name);
    if (shape_of(f, name, shape) == 0)
        return -1;
    const int64_t n = (int64_t)shape[0];
    return n * (f->rank + 1) / f->size - n * f->rank / f->size;
}

bool h5_read_real(struct h5 *f, const char *name, int64_t n, int ncomp, double *v)
{
    const struct h5_part p = rows_part(f, n, ncomp);
    return read_rows(f, name, &p, H5T_NATIVE_DOUBLE, v);
}

bool h5_read_int(struct h5 *f, const char *name, int64_t n, int64_t *v)
{
    const struct h5_part p = rows_part(f, n, 1);
    return read_rows(f, name, &p, H5T_NATIVE_INT64, v);
}

/* The answer is made common by a minimum first: ranks ask for ranges of their own here, and one
 * that does not fit must not leave the others in the transfer. */
static bool read_at(struct h5 *f, const char *name, int64_t first, int64_t n, int ncomp, hid_t type,
                    void *v)
{
    struct h5_part p = {.rank = ncomp > 1 ? 2 : 1, .empty = n == 0};
    hsize_t shape[4];
    const bool fits =
        ranks_all(f->comm, shape_of(f, name, shape) == p.rank && (hsize_t)(first + n) <= shape[0]);
    p.shape[0] = shape[0];
    p.first[0] = (hsize_t)first;
    p.count[0] = (hsize_t)n;
    p.shape[1] = p.count[1] = (hsize_t)ncomp;
    return fits && read_rows(f, name, &p, type, v);
}

bool h5_read_real_at(struct h5 *f, const char *name, int64_t first, int64_t n, int ncomp, double *v)
{
    return read_at(f, name, first, n, ncomp, H5T_NATIVE_DOUBLE, v);
}

static void *read_all(struct h5 *f, const char *name, int ncomp, hid_t type, int64_t *n)
{
    hsize_t shape[4];
    *n = shape_of(f, name, shape) > 0 ? (int64_t)shape[0] : -1;
    if (*n < 0)
        return NULL;
    void *v = mem_new((size_t)(*n * ncomp), 8);
    if (read_at(f, name, 0, *n, ncomp, type, v))
        return v;
    mem_free(v);
    return NULL;
}

double *h5_read_all_real(struct h5 *f, const char *name, int ncomp, int64_t *n)
{
    return read_all(f, name, ncomp, H5T_NATIVE_DOUBLE, n);
}

int64_t *h5_read_all_int(struct h5 *f, const char *name, int64_t *n)
{
    return read_all(f, name, 1, H5T_NATIVE_INT64, n);
}

/* Of n numbers from each of f->ranks writers, on another number of ranks: their sums, on rank 0
 * alone (the others get zeros, so that a sum over ranks is right), if `sums'; else the first
 * writer's, on all. */
static bool read_each(struct h5 *f, const char *name, int n, double *v, bool sums)
{
    if (f->ranks == 0 || f->ranks == f->size)
        return h5_read_real(f, name, n, 1, v);
    int64_t all;
    double *rows = h5_read_all_real(f, name, 1, &all);
    const bool fits = rows && all == (int64_t)n * f->ranks;
    memset(v, 0, (size_t)n * sizeof *v);
    for (int64_t k = 0; fits && k < (sums ? all : n); k++)
        v[k % n] += sums && f->rank > 0 ? 0.0 : rows[k];
    mem_free(rows);
    return fits;
}

bool h5_read_same(struct h5 *f, const char *name, int n, double *v)
{
    return read_each(f, name, n, v, false);
}

bool h5_read_parts(struct h5 *f, const char *name, int n, double *v)
{
    return read_each(f, name, n, v, true);
}

bool h5_writes(const struct h5 *f) { return f->writing; }

bool h5_keep(struct h5 *f, const char *name, double *v)
{
    if (!f->writing)
        return h5_read_attribute_real(f, name, v);
    h5_attribute_real(f, name, *v);
    return true;
}

bool h5_keep_same(struct h5 *f, const char *name, const char *unit, int n, double *v)
{
    if (!f->writing)
        return h5_read_same(f, name, n, v);
    h5_write_real(f, name, unit, n, 1, v, false);
    return true;
}

bool h5_keep_parts(struct h5 *f, const char *name, const char *unit, int n, double *v)
{
    return f->writing ? h5_keep_same(f, name, unit, n, v) : h5_read_parts(f, name, n, v);
}

bool h5_keep_rows(struct h5 *f, const char *name, const char *unit, int64_t n, int ncomp, double *v)
{
    int64_t found = n;
    double *rows = f->writing ? NULL : h5_read_all_real(f, name, ncomp, &found);
    const bool fits = f->writing || (rows && found == n);
    if (f->writing)
        h5_write_real(f, name, unit, f->rank == 0 ? n : 0, ncomp, v, false);
    else if (fits)
        memcpy(v, rows, (size_t)n * (size_t)ncomp * sizeof *v);
    mem_free(rows);
    return fits;
}

/* The counts of the writers become their running sum, each before its own records. */
int64_t *h5_first_rows(struct h5 *f, const char *name)
{
    int64_t n;
    int64_t *first = h5_read_all_int(f, key_text("%s_rows", name), &n), before = 0;
    if (!first || n != f->ranks) {
        mem_free(first);
        return NULL;
    }
    GROW(first, n, n + 1);
    for (int64_t r = 0; r <= n; r++) {
        const int64_t of = first[r];
        first[r] = before;
        before += of;
    }
    return first;
}
