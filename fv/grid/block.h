/* block.h - a rank's part of a Cartesian grid, uniform or with layers of unequal height along y:
 * positions, storage with ghost layers, halo.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>
#include <stdbool.h>
#include <stdint.h>

#include "part.h"
#include "rows.h"

/* The part; owned arrays are freed by block_free. */
struct block {
    MPI_Comm cart; /* the ranks in a Cartesian arrangement; owned */
    int dim;
    int cells[3];                /* of the whole grid */
    double origin[3], length[3]; /* m */
    double h[3];                 /* m: size of a cell; along y with rows of the even ones */
    struct rows *rows;           /* layers of unequal height; NULL: all are equal */
    bool periodic[3];
    int lo[3], hi[3];        /* this rank: lo <= i < hi */
    int n[3];                /* hi - lo */
    int g[3];                /* ghost layers: GHOSTS, 0 beyond dim */
    int64_t stride[3], size; /* of a field with its ghosts */
    int below[3], above[3];  /* neighbours' ranks, MPI_PROC_NULL at a closed side */
    double *send, *recv;     /* scratch of the halo */
};

/* Fewest cells of a rank along an axis that is cut. */
enum { LEAST = 3 };
/* Divides `size' ranks along the axes; false: not possible so that each has at least LEAST cells
 * along each axis that is cut, as its ghosts need. */
bool block_split(int size, int dim, const int *cells, int dims[3]);
/* Sets *b for this rank of comm; origin, length: of the whole grid, m. Collective. */
void block_create(struct block *b, MPI_Comm comm, int dim, const int *cells, const double *origin,
                  const double *length, const bool *periodic);
/* Gives it layers of the heights h, b->cells[1] of them, the upper `even' ones equal; b->h[1]
 * becomes their height. */
void block_set_rows(struct block *b, int even, const double *h);
/* Frees what the block owns, its communicator too. */
void block_free(struct block *b);
/* A field of b->size zeros; owned by the caller (mem_free). */
double *block_field(const struct block *b);
/* The whole block as one part, for loops that serve all kinds of grids. */
struct part block_part(const struct block *b);
/* Index of local cell (i, j, k), counted from 0 at lo; ghosts are negative or beyond n. */
static inline int64_t block_at(const struct block *b, int i, int j, int k)
{
    return (i + b->g[0]) + b->stride[1] * (j + b->g[1]) + b->stride[2] * (k + b->g[2]);
}
/* Whether side k of the domain (2 a: lower, 2 a + 1: upper) is one of this rank's and not
 * periodic. */
static inline bool block_has_side(const struct block *b, int k)
{
    const int a = k / 2;
    return a < b->dim && !b->periodic[a] && (k % 2 ? b->hi[a] == b->cells[a] : b->lo[a] == 0);
}

/* Local cell (i, j, k) of an index in a field. */
static inline void block_place(const struct block *b, int64_t c, int at[3])
{
    at[0] = (int)(c % b->stride[1]) - b->g[0];
    at[1] = (int)(c % b->stride[2] / b->stride[1]) - b->g[1];
    at[2] = (int)(c / b->stride[2]) - b->g[2];
}
/* Size along axis a, m, of the local cells whose index along it is i. */
static inline double block_size(const struct block *b, int a, int i)
{
    return a == 1 && b->rows ? b->rows->h[i] : b->h[a];
}
/* Distance of the centres of the local cells of index i from those of index i - 1 along axis a,
 * m. */
static inline double block_step(const struct block *b, int a, int i)
{
    return a == 1 && b->rows ? b->rows->step[i] : b->h[a];
}
/* Derivative of the centres' coordinate along axis a with respect to the index, m. */
static inline double block_scale(const struct block *b, int a, int i)
{
    return a == 1 && b->rows ? b->rows->scale[i] : b->h[a];
}
/* Local index along y of a cell. */
static inline int block_row(const struct block *b, int64_t c)
{
    return (int)(c % b->stride[2] / b->stride[1]) - b->g[1];
}
/* Volume of the cells of local layer j, m^dim. */
static inline double block_volume(const struct block *b, int j)
{
    return b->h[0] * block_size(b, 1, j) * b->h[2];
}
/* Centre x[3] of local cell (i, j, k), m; 0 beyond dim. */
void block_centre(const struct block *b, int i, int j, int k, double *x);
/* The same and the size h[3] of the cell along each axis, m. */
void block_cell(const struct block *b, int i, int j, int k, double *x, double *h);
/* Average over the cell at q, in local layer j, of the derivative along axis a, from averages,
 * fourth order. */
static inline double block_derivative(const struct block *b, const double *q, int a, int j)
{
    const int64_t d = b->stride[a];
    if (a == 1 && b->rows) {
        const double *w = b->rows->gradient[j] + 2;
        return (w[1] * q[d] + w[-1] * q[-d]) + (w[2] * q[2 * d] + w[-2] * q[-2 * d]) + w[0] * q[0];
    }
    return (8.0 * (q[d] - q[-d]) - (q[2 * d] - q[-2 * d])) / (12.0 * b->h[a]);
}
/* Fills the ghosts of nf fields, corners included, one direction after the other; ghosts at closed
 * sides stay as they are. Collective. */
void block_halo(const struct block *b, int nf, double *const *f);
/* The same of fields in single precision. */
void block_halo_single(const struct block *b, int nf, float *const *f);
/* Copies a field without its ghosts, x fastest: the local layers along y from `first' on. */
void block_pack_from(const struct block *b, int first, const double *f, double *packed);

/* Visits the local cells: (i, j, k) has index c. */
#define BLOCK_CELLS(b, i, j, k, c)                                                                 \
    for (int k = 0; k < (b)->n[2]; k++)                                                            \
        for (int j = 0; j < (b)->n[1]; j++)                                                        \
            for (int i = 0; i < (b)->n[0]; i++)                                                    \
                for (int64_t c = block_at(b, i, j, k), its_once_##c = 1; its_once_##c;             \
                     its_once_##c = 0)

/* Rows of local cells, `more' layers of ghosts included in the active directions: c is the index of
 * the row's first cell, len its length. */
#define BLOCK_ROWS(b, more, c, len) BLOCK_ROWS_AT (b, more, its_row_##c, c, len)
/* The same for those who want the row's place along y (j), too. */
#define BLOCK_ROWS_AT(b, more, j, c, len)                                                          \
    for (int its_layer_##c = (b)->g[2] ? -(more) : 0, j;                                           \
         its_layer_##c < (b)->n[2] + ((b)->g[2] ? (more) : 0); its_layer_##c++)                    \
        for (j = -(more); j < (b)->n[1] + (more); j++)                                             \
            for (int64_t c = block_at(b, -(more), j, its_layer_##c), len = (b)->n[0] + 2 * (more), \
                         its_once_##c = 1;                                                         \
                 its_once_##c; its_once_##c = 0)
