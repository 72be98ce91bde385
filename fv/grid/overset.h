/* overset.h - blocks that overlap: what is cut out, which cells are interpolated, from where.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OVERSET_H
#define FV_OVERSET_H

#include "mesh.h"

struct overset; /* bins for the search, donors of all fringe cells */

/* Sets what each cell of all blocks is and finds the donors; NULL: faults were added. */
struct overset *overset_create(const struct run *r, struct faults *f, struct mesh *m);
void overset_free(struct overset **o);
/* Of blocks that move, after they have been placed anew: what each cell is; then donors of this
 * rank's fringe and their exchange. A cell without donors is told by m->trouble. */
void overset_cut(struct mesh *m, const struct overset *o);
void overset_find(struct mesh *m, struct overset *o);
/* Both donors and rows of the matrix, after another cut. */
void overset_renew(struct mesh *m, struct overset *o);
/* m->fringes alone, of the places now. */
void overset_find_rows(struct mesh *m, const struct overset *o);
/* Values of the cells (of all blocks, 1: wanted) from donors computed now. Collective. */
void overset_interpolate(struct mesh *m, struct overset *o, unsigned char *const *wanted, int nf,
                         double *const *f);
/* Whether all cells of the fringe have donors; else the first that has none. */
struct overset_orphan {
    int block, cell[3];
    double x[3];
};
bool overset_sound(const struct mesh *m, struct overset *o, struct overset_orphan *first);
/* The exchange of the fringe, after the parts are known. */
void overset_exchange(struct mesh *m, const struct overset *o);
/* The cell of a block at x and the place in it (0 to 1); *move: period of the domain that was
 * added to x. false: not inside. */
bool overset_locate(const struct mesh *m, const struct overset *o, int block, const double *x,
                    int *cell, double *xi);
/* The computed cell at x of the latest block after `after' (-1: of all); false: none. */
bool overset_computed(const struct mesh *m, const struct overset *o, int after, const double *x,
                      int *block, int *cell);
/* Value at a place in each block's cells: for the tests and the gauges. width cells each way from
 * `from' with weights; false: no computed cells there. width 4 or 2. */
bool overset_weights(const struct mesh *m, int block, const int *cell, const double *xi,
                     int npoints, int width, int *from, double *weight);
/* Weights (4^dim, kept by r) of what has values, computed or not, for the average over a box of
 * size h around x, and who gives it; false: nothing does. */
bool overset_sample(const struct mesh *m, const struct overset *o, const double *x, const double *h,
                    struct mesh_request *r, double *weight);
/* The same for a place behind a closed side of the block, beside this cell: linear from the cells
 * there, no further than a cell beyond it. */
bool overset_sample_beyond(const struct mesh *m, int block, const int *cell, const double *x,
                           struct mesh_request *r, double *weight);
/* Bins alone: for gauges. */
struct overset *overset_search(const struct run *r, const struct mesh *m);

#endif
