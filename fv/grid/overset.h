/* overset.h - blocks that overlap (Chimera grids): what is cut out, which cells are interpolated
 * (the fringe), and from which donors.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "mesh.h"

struct overset; /* bins for the search, donors of all fringe cells */

/* Sets what each cell of all blocks is and finds the donors; NULL: faults were added. Owned by the
 * caller (FREE). */
struct overset *overset_create(const struct run *r, struct faults *f, struct mesh *m);
/* For blocks that move, after they have been placed anew: sets what each cell is. */
void overset_cut(struct mesh *m, const struct overset *o);
/* After that: finds the donors of this rank's fringe and makes their exchange. m->trouble names a
 * cell without donors. Collective. */
void overset_find(struct mesh *m, struct overset *o);
/* Finds donors and matrix rows again after another cut. */
void overset_renew(struct mesh *m, struct overset *o);
/* Finds m->fringes alone, for the present positions. */
void overset_find_rows(struct mesh *m, const struct overset *o);
/* Sets nf fields in the cells marked in `wanted' (per block, [cells]) from computed donors found
 * now. Collective. */
void overset_interpolate(struct mesh *m, struct overset *o, unsigned char *const *wanted, int nf,
                         double *const *f);
/* A cell of the fringe without donors. */
struct overset_orphan {
    int block, cell[3];
    double x[3]; /* m: its centre */
};
/* Whether all cells of the fringe have donors; else *first is the first that has none. */
bool overset_sound(const struct mesh *m, struct overset *o, struct overset_orphan *first);
/* Makes the exchange of the fringe, after the parts are known. */
void overset_exchange(struct mesh *m, const struct overset *o);
/* The cell of a block at x and the position xi in it (0 to 1); *move: periods of the domain that
 * were added to x. false: x is not inside. */
bool overset_locate(const struct mesh *m, const struct overset *o, int block, const double *x,
                    int *cell, double *xi);
/* The computed cell at x of the latest block after `after' (-1: of all); false: there is none. */
bool overset_computed(const struct mesh *m, const struct overset *o, int after, const double *x,
                      int *block, int *cell);
/* Weights of width (4 or 2) cells each way from `from' for the value at xi in a block's cell; for
 * gauges and tests. false: the cells there are not all computed. */
bool overset_weights(const struct mesh *m, int block, const int *cell, const double *xi,
                     int npoints, int width, int *from, double *weight);
/* Weights (4^dim, kept by r) for the average over a box of edges h around x, from cells that have
 * values, computed or not, and who owns them; false: nothing has. */
bool overset_sample(const struct mesh *m, const struct overset *o, const double *x, const double *h,
                    struct mesh_request *r, double *weight);
/* The same for a point behind a closed side of the block, beside this cell: linear from the cells
 * there, no further than a cell beyond it. */
bool overset_sample_beyond(const struct mesh *m, int block, const int *cell, const double *x,
                           struct mesh_request *r, double *weight);
/* Marks of this rank's cells, that a later block computes the flow at their centre, too, so that
 * sums over the flow leave them out; NULL: blocks do not overlap. stays: blocks, and what a partner
 * computes, stay where they are: then the marks of the last call hold. Owned by m. */
const bool *mesh_twice(const struct run *r, struct mesh *m, bool stays);
/* The bins of the search alone, for gauges. */
struct overset *overset_search(const struct run *r, const struct mesh *m);
