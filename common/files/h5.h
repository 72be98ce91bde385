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
/* mem_free; NULL if there is none. */
char *h5_read_attribute_text(struct h5 *f, const char *name);

/* Dataset /name[sum of n over ranks][ncomp] (rank 1 if ncomp is 1): this rank's n rows follow those
 * of the lower ranks. `unit' becomes the attribute "units". single: stored as float. n = 0 is
 * legal. */
void h5_write_real(struct h5 *f, const char *name, const char *unit, int64_t n, int ncomp,
                   const double *v, bool single);
void h5_write_int(struct h5 *f, const char *name, int64_t n, const int64_t *v);
/* A restart file also knows how many ranks wrote it, and of every dataset of rows how many each of
 * them wrote (dataset "NAME_rows"), so that any number of ranks can read it. */
struct h5 *h5_create_restart(MPI_Comm comm, const char *path);
/* Ranks that wrote the file; 0: it does not say. */
int h5_ranks(const struct h5 *f);
/* Rows this rank wrote; -1 if the number of ranks differs. */
int64_t h5_rows(struct h5 *f, const char *name);
/* Rows this rank is to read: its own, or an even share on another number of ranks; -1: there is no
 * such dataset. */
int64_t h5_share(struct h5 *f, const char *name);
bool h5_read_real(struct h5 *f, const char *name, int64_t n, int ncomp, double *v);
bool h5_read_int(struct h5 *f, const char *name, int64_t n, int64_t *v);
/* The n rows from `first' on; each rank asks for its own, n = 0 is legal. */
bool h5_read_real_at(struct h5 *f, const char *name, int64_t first, int64_t n, int ncomp,
                     double *v);
bool h5_read_int_at(struct h5 *f, const char *name, int64_t first, int64_t n, int64_t *v);
/* All rows on every rank, *n of them; NULL if there is no such dataset, else mem_free. */
double *h5_read_all_real(struct h5 *f, const char *name, int ncomp, int64_t *n);
int64_t *h5_read_all_int(struct h5 *f, const char *name, int64_t *n);
/* n numbers that every rank wrote: its own, or on another number of ranks the first one's, for
 * numbers that all hold alike, and the sum on the first and nothing on the others, for parts of a
 * sum. */
bool h5_read_same(struct h5 *f, const char *name, int n, double *v);
bool h5_read_parts(struct h5 *f, const char *name, int n, double *v);
/* First row of each writing rank, and one more: h5_ranks(f) + 1; NULL as above. */
int64_t *h5_first_rows(struct h5 *f, const char *name);

/* Block of a dataset of shape cells[dim-1] .. cells[0] (x fastest) with ncomp components last (none
 * if 1): this rank writes its [lo, hi) from v[(hi-lo) cells, x fastest][ncomp]. */
void h5_write_block(struct h5 *f, const char *name, const char *unit, int dim, const int *cells,
                    const int *lo, const int *hi, int ncomp, const double *v, bool single);

#endif
