/* map.h - values at points from the points of another cloud: what a mapping provides.
 * No MPI: the caller brings together every source within R of a target.
 *
 * Kernel: Wendland C2 of support radius R, W = C/theta (1 - q)^4 (1 + 4 q). Its second moment per
 * direction is 5/72 R^2 in 2D and R^2/15 in 3D; that of the mean over a cell of edge h is h^2/12.
 * With R = 1.095 h (2D) or 1.118 h (3D) a Shepard sum is therefore a cell average up to fourth
 * order, where enough sources fit in. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_MAP_H
#define COUPLER_MAP_H

#include <stdint.h>

/* Sources, in any order: sums run in the order of gid, so that neither the order nor the number of
 * ranks shows in the result. Images of a point share its gid. */
struct map_cloud {
    long n;
    double *x;      /* [n][dim], m */
    int64_t *gid;   /* [n] */
    double *volume; /* [n] m^dim */
    double *v;      /* [n][ncomp] */
};

/* v[ntarget][ncomp] at x[ntarget][dim]; mask 1: mapped; 0: no source within R, v is 0. Sorts the
 * cloud. */
typedef void map_points(int dim, double R, int ncomp, struct map_cloud *from, long ntarget,
                        const double *x, double *v, unsigned char *mask);

/* sum w_j f_j W / sum w_j W: partition of unity, exact on constants, never an overshoot. */
map_points map_shepard;
/* Moving least squares with the basis 1, (x_j - x)/R: exact on linear functions; Shepard where
 * sources are fewer than 2 (dim + 1) or their moments have a condition number above 1e6. */
map_points map_mls;

/* The value of the nearest source, of equally near ones that of the lowest gid. */
map_points map_nearest;

/* sum w_j f_j W, not divided by anything: the mask is 1 everywhere. */
map_points map_sum;

/* The transpose of a consistent mapping: what each source has is dealt out to the targets by the
 * weights with which the consistent one, from the targets to the source, would gather: they add up
 * to 1, so sums over all points are kept to rounding (those of moving least squares keep first
 * moments, too). A source without a target within R gives all to the nearest one, however far. */
enum map_dealing { MAP_DEAL_SHEPARD, MAP_DEAL_MLS, MAP_DEAL_NEAREST };
/* All targets (their v is not used) and all sources of the job; v[last - first][ncomp] of the
 * targets first <= i < last, sums in the order of the sources' gid. period: 0 not periodic. Sorts
 * the sources. */
void map_deal(enum map_dealing how, int dim, double R, int ncomp, const double period[3],
              const struct map_cloud *target, struct map_cloud *source, long first, long last,
              double *v);

double map_kernel(int dim, double r, double R); /* W, 1/m^dim */
void map_cloud_free(struct map_cloud *c);

#endif
