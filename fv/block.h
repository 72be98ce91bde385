/* block.h - a rank's part of a uniform Cartesian grid: places, storage with ghost layers, halo.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_BLOCK_H
#define FV_BLOCK_H

#include <mpi.h>
#include <stdbool.h>
#include <stdint.h>

enum { GHOSTS = 3 };

struct block {
    MPI_Comm cart;
    int dim;
    int cells[3];           /* of the whole grid */
    double origin[3], h[3]; /* m */
    bool periodic[3];
    int lo[3], hi[3];        /* this rank: lo <= i < hi */
    int n[3];                /* hi - lo */
    int g[3];                /* ghost layers: GHOSTS, 0 beyond dim */
    int64_t stride[3], size; /* of a field with its ghosts */
    int below[3], above[3];  /* neighbours' ranks, MPI_PROC_NULL at a closed side */
    double *send, *recv;     /* scratch of the halo */
};

void block_create(struct block *b, MPI_Comm comm, int dim, const int *cells, const double *origin,
                  const double *length, const bool *periodic);
void block_free(struct block *b);
double *block_field(const struct block *b);
/* Index of local cell (i, j, k), counted from 0 at lo; ghosts are negative or beyond n. */
static inline int64_t block_at(const struct block *b, int i, int j, int k)
{
    return (i + b->g[0]) + b->stride[1] * (j + b->g[1]) + b->stride[2] * (k + b->g[2]);
}
/* Centre of local cell (i, j, k). */
void block_centre(const struct block *b, int i, int j, int k, double *x);
/* Ghosts of nf fields, corners included, by one direction after the other; closed sides keep
 * theirs. */
void block_halo(const struct block *b, int nf, double *const *f);
/* Fields without ghosts, x fastest, from and to those with. */
void block_pack(const struct block *b, const double *f, double *packed);
void block_unpack(const struct block *b, const double *packed, double *f);

/* Rows of local cells, `more' layers of ghosts included in the active directions: c is the index of
 * the row's first cell, n its length. */
#define BLOCK_ROWS(b, more, c, len)                                                                \
    for (int k_ = (b)->g[2] ? -(more) : 0, j_; k_ < (b)->n[2] + ((b)->g[2] ? (more) : 0); k_++)    \
        for (j_ = -(more); j_ < (b)->n[1] + (more); j_++)                                          \
            for (int64_t c = block_at(b, -(more), j_, k_), len = (b)->n[0] + 2 * (more),           \
                         once_ = 1;                                                                \
                 once_; once_ = 0)

#endif
