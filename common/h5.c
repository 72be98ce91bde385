/* h5.c - see h5.h. Any failure of the library ends the run: a restart file that cannot be written
 * must not be missed. SPDX-License-Identifier: BSD-3-Clause */
#include "h5.h"

#include <errno.h>
#include <hdf5.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "disk.h"
#include "log.h"
#include "mem.h"

struct h5 {
    MPI_Comm comm;
    int rank, size;
    hid_t file, transfer;
    bool writing, restart;
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
            fail("HDF5: %s failed on %s", #call, f->path);                                         \
        }                                                                                          \
    } while (0)

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
    return f;
}

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
    return f;
}

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

/* --- datasets --- */

/* Where a rank's part lies in a dataset, and its shape. */
struct part {
    int rank;
    hsize_t shape[4], first[4], count[4];
    bool empty;
};

static void transfer(struct h5 *f, hid_t set, const struct part *p, hid_t type, void *v, bool write)
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

static void write_part(struct h5 *f, const char *name, const char *unit, const struct part *p,
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

/* Rows of this rank behind those of the lower ranks. */
static struct part rows_part(const struct h5 *f, int64_t n, int ncomp)
{
    int64_t first = 0, all = 0;
    MPI_Exscan(&n, &first, 1, MPI_INT64_T, MPI_SUM, f->comm);
    if (f->rank == 0)
        first = 0;
    MPI_Allreduce(&n, &all, 1, MPI_INT64_T, MPI_SUM, f->comm);
    struct part p = {.rank = ncomp > 1 ? 2 : 1, .empty = n == 0};
    p.shape[0] = (hsize_t)all;
    p.first[0] = (hsize_t)first;
    p.count[0] = (hsize_t)n;
    p.shape[1] = p.count[1] = (hsize_t)ncomp;
    return p;
}

static void write_rows(struct h5 *f, const char *name, int64_t n)
{
    char rows[256];
    if (!f->restart)
        return;
    snprintf(rows, sizeof rows, "%s_rows", name);
    const struct part p = rows_part(f, 1, 1);
    write_part(f, rows, NULL, &p, H5T_NATIVE_INT64, H5T_NATIVE_INT64, &n);
}

void h5_write_real(struct h5 *f, const char *name, const char *unit, int64_t n, int ncomp,
                   const double *v, bool single)
{
    const struct part p = rows_part(f, n, ncomp);
    write_part(f, name, unit, &p, single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, v);
    write_rows(f, name, n);
}

void h5_write_int(struct h5 *f, const char *name, int64_t n, const int64_t *v)
{
    const struct part p = rows_part(f, n, 1);
    write_part(f, name, NULL, &p, H5T_STD_I64LE, H5T_NATIVE_INT64, v);
    write_rows(f, name, n);
}

void h5_write_block(struct h5 *f, const char *name, const char *unit, int dim, const int *cells,
                    const int *lo, const int *hi, int ncomp, const double *v, bool single)
{
    struct part p = {.rank = dim + (ncomp > 1)};
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

static bool read_rows(struct h5 *f, const char *name, const struct part *p, hid_t type, void *v)
{
    hid_t set, space;
    hsize_t shape[4] = {0};
    if (H5Lexists(f->file, name, H5P_DEFAULT) <= 0)
        return false;
    H5(set = H5Dopen2(f->file, name, H5P_DEFAULT));
    H5(space = H5Dget_space(set));
    const int rank = H5Sget_simple_extent_ndims(space);
    bool fits = rank == p->rank;
    if (fits)
        H5Sget_simple_extent_dims(space, shape, NULL);
    for (int k = 0; fits && k < rank; k++)
        fits = shape[k] == p->shape[k];
    H5(H5Sclose(space));
    if (fits && p->shape[0] > 0)
        transfer(f, set, p, type, v, false);
    H5(H5Dclose(set));
    return fits;
}

int64_t h5_rows(struct h5 *f, const char *name)
{
    char rows[256];
    int64_t n = 0;
    snprintf(rows, sizeof rows, "%s_rows", name);
    const struct part p = rows_part(f, 1, 1);
    return read_rows(f, rows, &p, H5T_NATIVE_INT64, &n) ? n : -1;
}

bool h5_read_real(struct h5 *f, const char *name, int64_t n, int ncomp, double *v)
{
    const struct part p = rows_part(f, n, ncomp);
    return read_rows(f, name, &p, H5T_NATIVE_DOUBLE, v);
}

bool h5_read_int(struct h5 *f, const char *name, int64_t n, int64_t *v)
{
    const struct part p = rows_part(f, n, 1);
    return read_rows(f, name, &p, H5T_NATIVE_INT64, v);
}
