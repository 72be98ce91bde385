/* map.h - mappings: values at target points from the points of another cloud. Local to a rank, no
 * MPI: the caller brings together every source within R of a target.
 *
 * Kernel: Wendland C2 of support radius R, W = C/theta (1 - q)^4 (1 + 4 q). Its second moment per
 * direction is 5/72 R^2 in 2D and R^2/15 in 3D; that of the mean over a cell of edge h is h^2/12.
 * With R = 1.095 h (2D) or 1.118 h (3D) a Shepard sum is therefore a cell average up to fourth
 * order, where enough sources fit in.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdint.h>

/* Sources, in any order: sums run in the order of gid, the global number, so that neither the order
 * nor the number of ranks shows in the result. Images of a point share its gid. Arrays are owned,
 * see map_cloud_free. */
struct map_cloud {
    long n;
    double *x;      /* [n][dim], m */
    int64_t *gid;   /* [n] global numbers */
    double *volume; /* [n] m^dim: weights w */
    double *v;      /* [n][ncomp] values f */
};

/* A consistent mapping. Sets v[ntarget][ncomp] at x[ntarget][dim], m, and mask: 1 mapped; 0 no
 * source with a noticeable weight (sum of w W at least 1e-6) within R, v is 0. Sorts the cloud. */
typedef void map_points(int dim, double R, int ncomp, struct map_cloud *from, long ntarget,
                        const double *x, double *v, unsigned char *mask);

/* sum w_j f_j W / sum w_j W: partition of unity, exact on constants, never an overshoot. */
map_points map_shepard;
/* Moving least squares with the basis 1, (x_j - x)/R: exact on linear functions; Shepard where
 * sources are fewer than 2 (dim + 1) or their moments have a condition number above 1e6. */
map_points map_mls;

/* The value of the nearest source within R; of equally near ones that of the lowest gid. */
map_points map_nearest;

/* sum w_j f_j W, not divided by anything; the mask is 1 everywhere. */
map_points map_sum;

/* The transpose of a consistent mapping: the value of each source is distributed over the targets
 * by the weights with which the consistent one, from the targets to the source, would gather. They
 * add up to 1, so that sums over all points are conserved to rounding (those of moving least
 * squares conserve first moments, too). A source without a target within R gives all to the nearest
 * one, however far. */
enum map_dealing { MAP_DEAL_SHEPARD, MAP_DEAL_MLS, MAP_DEAL_NEAREST };
/* Distributes over all targets (their v is not used) the values of all sources of the job, and
 * keeps in v[last - first][ncomp] what the targets first <= i < last get. Sums run in the order of
 * the sources' gid. period, m: 0 not periodic. Sorts the sources. */
void map_deal(enum map_dealing how, int dim, double R, int ncomp, const double period[3],
              const struct map_cloud *target, struct map_cloud *source, long first, long last,
              double *v);

/* W at the distance q R for the support R, 1/m^dim. */
double map_kernel(int dim, double q, double R);
/* Room for n points with ncomp values each. */
void map_cloud_room(struct map_cloud *c, int dim, long ncomp, long n);
/* Frees the arrays and leaves an empty cloud. */
void map_cloud_free(struct map_cloud *c);
