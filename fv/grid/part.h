/* part.h - a rank's part of a block of cells, and where its cells lie in the fields.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* EVEN: all cells are equal boxes along the axes; UPRIGHT: boxes along the axes of any size;
 * CURVED: any shape. */
enum part_kind { PART_CURVED, PART_UPRIGHT, PART_EVEN };

/* A rank's part of a block. Cell (i, j, k), counted from 0 at lo, lies at part_at in every
 * field. */
struct part {
    enum part_kind kind;
    int block;       /* its number; of uniform cells 0 */
    int lo[3], n[3]; /* indices of its first cell in the block, numbers of its cells */
    int g[3];        /* layers of ghosts at each end; 0 beyond dim */
    int64_t base, stride[3],
        size; /* index of the first ghost; offsets to neighbours; entries in a field */
    /* First cell and number of the cells near water, of each line of cells along x, those of ghosts
     * included (surface/near_water.c); NULL: all are near. */
    int (*near)[2];
    /* The same of cells that hold water and one more in all directions: what is computed for the
     * water alone. */
    int (*wet)[2];
};

/* Number of the line of cells (j, k), ghosts included, in near and wet. */
static inline int part_row(const struct part *p, int j, int k)
{
    return j + p->g[1] + (k + p->g[2]) * (p->n[1] + 2 * p->g[1]);
}
/* Index along x of the first cell of the line (j, k) in runs, which are near or wet, less `down'
 * cells. */
static inline int part_first(const struct part *p, int (*const runs)[2], int down, int j, int k)
{
    return (runs ? runs[part_row(p, j, k)][0] : 0) - down;
}
/* Number of cells in that line, with `down' and `up' more at its ends; 0: there are none. */
static inline int part_count(const struct part *p, int (*const runs)[2], int down, int up, int j,
                             int k)
{
    const int n = runs ? runs[part_row(p, j, k)][1] : p->n[0];
    return n > 0 ? n + down + up : 0;
}

/* Begin and end of a run (first cell and number, as in near) with the ghosts that lie beside it. */
static inline void part_with_ghosts(const struct part *p, const int run[2], int ends[2])
{
    const int g = run[1] > 0 ? p->g[0] : 0;
    ends[0] = run[0] - (run[0] == 0 ? g : 0);
    ends[1] = run[0] + run[1] + (run[0] + run[1] == p->n[0] ? g : 0);
}

/* Cuts the indices from ends[0] to before ends[1] along x of the line (j, k) to what is within the
 * ghosts' width of cells near water; none may be left. */
static inline void part_clip(const struct part *p, int j, int k, int ends[2])
{
    const int *run = p->near ? p->near[part_row(p, j, k)] : NULL;
    if (!run)
        return;
    const int first = run[0] - p->g[0], end = run[1] > 0 ? run[0] + run[1] + p->g[0] : first;
    ends[0] = ends[0] > first ? ends[0] : first;
    ends[1] = ends[1] < end ? ends[1] : end;
}

/* Index in a field of cell (i, j, k), which may be a ghost. */
static inline int64_t part_at(const struct part *p, int i, int j, int k)
{
    return p->base + (i + p->g[0]) + p->stride[1] * (j + p->g[1]) + p->stride[2] * (k + p->g[2]);
}
/* Whether i (int[3]) is one of its cells, not a ghost. */
static inline bool part_has(const struct part *p, const int *i)
{
    return i[0] >= 0 && i[0] < p->n[0] && i[1] >= 0 && i[1] < p->n[1] && i[2] >= 0 &&
           i[2] < p->n[2];
}
/* The cell at index c, the inverse of part_at. */
static inline void part_index(const struct part *p, int64_t c, int *at)
{
    c -= p->base;
    at[2] = p->g[2] > 0 ? (int)(c / p->stride[2]) - p->g[2] : 0;
    c = p->g[2] > 0 ? c % p->stride[2] : c;
    at[1] = (int)(c / p->stride[1]) - p->g[1];
    at[0] = (int)(c % p->stride[1]) - p->g[0];
}

/* No layers more, for the macros below. */
static const int no_layers[3] = {0, 0, 0};

/* Rows of a part's cells; `down' and `up' layers (int[3]) more: c is the place of the row's first
 * cell, len its length. */
#define PART_ROWS(p, down, up, c, len)                                                             \
    PART_ROWS_AT (p, down, up, its_row_##c, its_layer_##c, c, len)
/* The same for those who want the row's place along y and z (j, k), too. */
#define PART_ROWS_AT(p, down, up, j, k, c, len)                                                    \
    for (int k = -(down)[2], j; k < (p)->n[2] + (up)[2]; k++)                                      \
        for (j = -(down)[1]; j < (p)->n[1] + (up)[1]; j++)                                         \
            for (int64_t c = part_at(p, -(down)[0], j, k), len = (p)->n[0] + (down)[0] + (up)[0],  \
                         its_once_##c = 1;                                                         \
                 its_once_##c; its_once_##c = 0)

/* The same of cells near water alone, and of water with one cell around. */
#define PART_NEAR(p, down, up, c, len) PART_RUNS(p, (p)->near, down, up, c, len)
#define PART_WET(p, down, up, c, len) PART_RUNS(p, (p)->wet, down, up, c, len)
#define PART_RUNS(p, runs, down, up, c, len)                                                       \
    for (int its_layer_##c = -(down)[2], its_row_##c; its_layer_##c < (p)->n[2] + (up)[2];         \
         its_layer_##c++)                                                                          \
        for (its_row_##c = -(down)[1]; its_row_##c < (p)->n[1] + (up)[1]; its_row_##c++)           \
            for (int64_t                                                                           \
                     c = part_at(p, part_first(p, runs, (down)[0], its_row_##c, its_layer_##c),    \
                                 its_row_##c, its_layer_##c),                                      \
                     len = part_count(p, runs, (down)[0], (up)[0], its_row_##c, its_layer_##c),    \
                     its_once_##c = 1;                                                             \
                 its_once_##c; its_once_##c = 0)

/* Visits a part's cells and its ghosts: i (int[3]) has place c. */
#define PART_ALL(p, i, c)                                                                          \
    for ((i)[2] = -(p)->g[2]; (i)[2] < (p)->n[2] + (p)->g[2]; (i)[2]++)                            \
        for ((i)[1] = -(p)->g[1]; (i)[1] < (p)->n[1] + (p)->g[1]; (i)[1]++)                        \
            for ((i)[0] = -(p)->g[0]; (i)[0] < (p)->n[0] + (p)->g[0]; (i)[0]++)                    \
                for (int64_t c = part_at(p, (i)[0], (i)[1], (i)[2]), its_once_##c = 1;             \
                     its_once_##c; its_once_##c = 0)
/* The same of the cells alone. */
#define PART_CELLS(p, i, c)                                                                        \
    for ((i)[2] = 0; (i)[2] < (p)->n[2]; (i)[2]++)                                                 \
        for ((i)[1] = 0; (i)[1] < (p)->n[1]; (i)[1]++)                                             \
            for ((i)[0] = 0; (i)[0] < (p)->n[0]; (i)[0]++)                                         \
                for (int64_t c = part_at(p, (i)[0], (i)[1], (i)[2]), its_once_##c = 1;             \
                     its_once_##c; its_once_##c = 0)
