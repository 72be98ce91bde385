/* forced_points.h - where a partner is asked for the values of FV's cells: at their centres; of
 * cells larger than the kernel that the partner's values are seen through at several places, whose
 * mean has the second moment of the cell's average. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FORCED_POINTS_H
#define FV_FORCED_POINTS_H

#include "../boundary/fv_boundary.h"

struct forced_points {
    int64_t ncells, n;
    int64_t *first; /* of each cell's points, and one more */
    double *x;      /* [n][3] m */
    int64_t *id;    /* of all ranks, in the order of cells */
};

/* Of the cells in s->forcing->partner. h: m, edge of a cell whose average the kernel is; along y of
 * rows and, if the box moves, of blocks, cells are cut to it. */
struct forced_points forced_points_create(const struct fv *s, void *owner, double h);
/* Means of the points' values v[n][ncomp] where the partner has some (mask 1), of each cell to
 * to[ncells][ncomp] and has[ncells]. */
void forced_points_mean(const struct forced_points *p, int ncomp, const double *v,
                        const unsigned char *mask, double *to, unsigned char *has);

#endif
