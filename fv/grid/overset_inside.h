/* overset_inside.h - what the files of overset.h share; private to them.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "overset.h"

/* The cells of one block sorted into boxes, to find the one at a position. */
struct bins {
    double lo[3], hi[3], size[3]; /* m */
    int n[3];
    int64_t *first; /* of each bin, and one more */
    int *cell;
    double *line[3]; /* rectilinear blocks: vertices along the axes before the rotation */
};

/* A fringe cell of this rank with its donors and the weights of both interpolations. */
struct donor {
    int block, cell[3]; /* that receives */
    int from_block, from[3], linear_from[3];
    int at[3]; /* the donor cell itself */
    int width; /* of the cells that give: 4, or 2 */
    double weight[64], linear[8];
};

/* Bins of all blocks and the donors of this rank's fringe. */
struct overset {
    struct bins bins[MESH_BLOCKS_MAX];
    int64_t n, room;
    struct donor *donor;
    int64_t n_old, room_old; /* those of the last search */
    struct donor *old;
    bool rows_only;             /* linear weights are found alone */
    int *last[MESH_BLOCKS_MAX]; /* of each cell in old, and one more; NULL: nothing moves */
    bool periodic[3];
    double length[3], least[3];
};

/* Sets of what cells may be, as bits. */
enum {
    OF_COMPUTED = 1 << CELL_COMPUTED,
    OF_KNOWN = OF_COMPUTED | 1 << CELL_GIVEN, /* all but what takes from others itself */
    OF_ANY = OF_KNOWN | 1 << CELL_FRINGE      /* all that have values */
};

/* overset_search.c: Newton's iteration for the position xi of x in the smooth map of a cell; false:
 * it does not converge. */
bool overset_invert(const struct mesh_block *b, int dim, const int *cell, const double *x,
                    double *xi);

/* overset_stencil.c. overset_all: whether cells lo to hi - 1, which may lie behind joined sides,
 * are all of this set. overset_stencil: the first cell of the stencil around a position, kept among
 * the cells; false: not all of it are of this set. */
bool overset_all(const struct mesh *m, int block, const int *lo, const int *hi, int set);
bool overset_stencil(const struct mesh *m, int block, const int *cell, const double *xi, int width,
                     int set, int *from);
/* Puts a linear stencil into the store of a cubic one: the same window, zeros around. */
void overset_widen(const struct mesh *m, struct donor *d);
/* Index, on its owner, of the first cell of a donor's stencil. */
int64_t overset_place(const struct mesh *m, const struct donor *d, int *rank);

/* Whether cells continue behind a side of the block. */
static inline bool overset_leads_on(const struct mesh_block *b, int side)
{
    return b->side[side] == MESH_JOINED || b->side[side] == MESH_PERIODIC;
}

/* overset_cut.c: counts computed and interpolated cells of all blocks again. */
void overset_count(struct mesh *m);
