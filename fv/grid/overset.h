/* overset.h - blocks that overlap: what is cut out, which cells are interpolated, from where.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OVERSET_H
#define FV_OVERSET_H

#include "mesh.h"

struct overset; /* bins for the search, donors of all fringe cells */

/* Sets what each cell of all blocks is and finds the donors; NULL: faults were added. */
struct overset *overset_create(const struct run *r, struct faults *f, struct mesh *m);
void overset_free(struct overset **o);
/* The exchange of the fringe, after the parts are known. */
void overset_exchange(struct mesh *m, const struct overset *o);
/* The cell of a block at x and the place in it (0 to 1); *move: period of the domain that was
 * added to x. false: not inside. */
bool overset_locate(const struct mesh *m, const struct overset *o, int block, const double *x,
                    int *cell, double *xi);
/* Value at a place in each block's cells: for the tests and the gauges. width cells each way from
 * `from' with weights; false: no computed cells there. width 4 or 2. */
bool overset_weights(const struct mesh *m, int block, const int *cell, const double *xi,
                     int npoints, int width, int *from, double *weight);
/* Bins alone: for gauges. */
struct overset *overset_search(const struct run *r, const struct mesh *m);

#endif
