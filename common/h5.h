/* h5.h - parallel HDF5 files, closed as soon as written: snapshots and restart files.
 * All calls are collective over the communicator of h5_create / h5_open.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_H5_H
#define COMMON_H5_H

#include <mpi.h>
#include <stdbool.h>
#include <stdint.h>

struct h5; /* an open file */

/* Writes to PATH.part and renames at h5_close: a file under its name is complete. */
struct h5 *h5_create(MPI_Comm comm, const char *path);
/* NULL if there is no such file or it is no HDF5 file. */
struct h5 *h5_open(MPI_Comm comm, const char *path);
void h5_close(struct h5 **f);
const char *h5_path(const struct h5 *f);

void h5_attribute_real(struct h5 *f, const char *name, double value);
void h5_attribute_int(struct h5 *f, const char *name, int64_t value);
void h5_attribute_text(struct h5 *f, const char *name, const char *value);
bool h5_read_attribute_real(struct h5 *f, const char *name, double *value);
bool h5_read_attribute_int(struct h5 *f, const char *name, int64_t *value);

/* Dataset /name[sum of n over ranks][ncomp] (rank 1 if ncomp is 1): this rank's n rows follow those
 * of the lower ranks. `unit' becomes the attribute "units". single: stored as float. n = 0 is
 * legal. */
void h5_write_real(struct h5 *f, const char *name, const char *unit, int64_t n, int ncomp,
                   const double *v, bool single);
void h5_write_int(struct h5 *f, const char *name, int64_t n, const int64_t *v);
/* Rows this rank wrote, by the dataset "NAME_rows" of counts that every h5_write_* leaves behind
 * when the file was made by h5_create_restart. -1 if the number of ranks differs. */
struct h5 *h5_create_restart(MPI_Comm comm, const char *path);
int64_t h5_rows(struct h5 *f, const char *name);
bool h5_read_real(struct h5 *f, const char *name, int64_t n, int ncomp, double *v);
bool h5_read_int(struct h5 *f, const char *name, int64_t n, int64_t *v);

/* Block of a dataset of shape cells[dim-1] .. cells[0] (x fastest) with ncomp components last (none
 * if 1): this rank writes its [lo, hi) from v[(hi-lo) cells, x fastest][ncomp]. */
void h5_write_block(struct h5 *f, const char *name, const char *unit, int dim, const int *cells,
                    const int *lo, const int *hi, int ncomp, const double *v, bool single);

#endif
