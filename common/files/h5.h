/* h5.h - parallel HDF5 files, closed as soon as written: snapshots and restart files. All calls but
 * h5_path and h5_ranks are collective over the communicator of h5_create or h5_open, whose ranks
 * each hold a contiguous range of a dataset's records (its first index), in order of rank. A
 * failure inside the library ends the run: of a write as a fault of the disk (disk_failed), of a
 * read through abort_run(). Readers return false or NULL, on all ranks alike, where name or shape
 * do not fit. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>
#include <stdbool.h>
#include <stdint.h>

/* an open file: made by h5_create, h5_create_restart or h5_open, freed by h5_close */
struct h5;

/* Opens PATH.part for writing; h5_close renames it to `path', so that a file under its own name is
 * complete. path is copied. */
struct h5 *h5_create(MPI_Comm comm, const char *path);
/* Opens a file for reading. NULL on all ranks if it cannot be read or is no HDF5 file. */
struct h5 *h5_open(MPI_Comm comm, const char *path);
/* Closes the file on all ranks, seals a restart file with its checksum (disk_seal), renames it and
 * sets *f to NULL. *f may be NULL. */
void h5_close(struct h5 **f);
/* The path as given to h5_create or h5_open; borrowed until h5_close. */
const char *h5_path(const struct h5 *f);

/* Attributes of the file's root. All ranks must pass the same value. */
void h5_attribute_real(struct h5 *f, const char *name, double value);
void h5_attribute_int(struct h5 *f, const char *name, int64_t value);
void h5_attribute_text(struct h5 *f, const char *name, const char *value);
/* false: there is none of this name, *value is untouched. */
bool h5_read_attribute_real(struct h5 *f, const char *name, double *value);
bool h5_read_attribute_int(struct h5 *f, const char *name, int64_t *value);
/* Owned by the caller (mem_free); NULL if there is none of this name. */
char *h5_read_attribute_text(struct h5 *f, const char *name);

/* Writes dataset /name of shape [sum of n over ranks][ncomp], or one index if ncomp is 1: the n
 * records of this rank, v[n][ncomp], follow those of the lower ranks. `unit' becomes the attribute
 * "units"; NULL: none. single: stored as float. n = 0 is legal on any rank. */
void h5_write_real(struct h5 *f, const char *name, const char *unit, int64_t n, int ncomp,
                   const double *v, bool single);
void h5_write_int(struct h5 *f, const char *name, int64_t n, const int64_t *v);
/* As h5_create, for a restart file: it also holds how many ranks wrote it (attribute "ranks") and
 * for every dataset of records how many each of them wrote (dataset "NAME_rows"), so that any
 * number of ranks can read it. */
struct h5 *h5_create_restart(MPI_Comm comm, const char *path);
/* Number of ranks that wrote the file; 0: the file does not say, it is no restart file. */
int h5_ranks(const struct h5 *f);
/* Records of /name that the rank of this number wrote; -1 if a different number of ranks wrote the
 * file or it holds no such count. */
int64_t h5_rows(struct h5 *f, const char *name);
/* Records of /name that this rank is to read: those it wrote, or an equal share of all on another
 * number of ranks; -1: there is no such dataset. */
int64_t h5_share(struct h5 *f, const char *name);
/* Reads this rank's n records of /name into v[n][ncomp], those of the lower ranks come before.
 * false if the sum of n over ranks is not the dataset's length. */
bool h5_read_real(struct h5 *f, const char *name, int64_t n, int ncomp, double *v);
bool h5_read_int(struct h5 *f, const char *name, int64_t n, int64_t *v);
/* Reads the n records from record `first' on. Each rank asks for its own range, ranges may overlap;
 * n = 0 is legal. false on all ranks if the range of any rank is not in the dataset. */
bool h5_read_real_at(struct h5 *f, const char *name, int64_t first, int64_t n, int ncomp,
                     double *v);
/* All records on every rank, [*n][ncomp], owned by the caller (mem_free). NULL if there is no such
 * dataset, or its shape differs. */
double *h5_read_all_real(struct h5 *f, const char *name, int ncomp, int64_t *n);
int64_t *h5_read_all_int(struct h5 *f, const char *name, int64_t *n);
/* n numbers that every rank wrote with h5_write_real. On the same number of ranks each gets its own
 * back. On another number h5_read_same gives all ranks what the first one wrote, which suits
 * numbers that are equal on all ranks; h5_read_parts gives the sum to the first rank and zeros to
 * the others, which suits each rank's part of a global sum. false: length or name do not fit. */
bool h5_read_same(struct h5 *f, const char *name, int n, double *v);
bool h5_read_parts(struct h5 *f, const char *name, int n, double *v);
/* What a restart file keeps, said once for both ways: one that is written takes v, one that is read
 * gives it; false: it has none that fits, and v is as it was, or zero. In this order: a number that
 * all ranks have; n numbers as of h5_read_same; as of h5_read_parts; n rows of ncomp numbers that
 * all ranks have and the first one writes. h5_writes: which way it is. */
bool h5_keep(struct h5 *f, const char *name, double *v);
bool h5_keep_same(struct h5 *f, const char *name, const char *unit, int n, double *v);
bool h5_keep_parts(struct h5 *f, const char *name, const char *unit, int n, double *v);
bool h5_keep_rows(struct h5 *f, const char *name, const char *unit, int64_t n, int ncomp,
                  double *v);
bool h5_writes(const struct h5 *f);
/* Number of the first record that each writing rank wrote, and their sum as a last element:
 * [h5_ranks(f) + 1], owned by the caller (mem_free). NULL if the file does not say. */
int64_t *h5_first_rows(struct h5 *f, const char *name);

/* Writes this rank's block of the dataset /name of shape [cells[dim-1]] .. [cells[0]], x fastest,
 * with ncomp components as the last index (none if 1): the cells lo <= i < hi, which lie in v[(hi -
 * lo) cells, x fastest][ncomp] without ghosts. lo, hi, cells have dim elements. A rank whose block
 * is empty takes part with hi <= lo. `unit' and `single' are those of h5_write_real. */
void h5_write_block(struct h5 *f, const char *name, const char *unit, int dim, const int *cells,
                    const int *lo, const int *hi, int ncomp, const double *v, bool single);
