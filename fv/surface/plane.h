/* plane.h - water below a plane in a cell. Places in a cell go from -1/2 to 1/2 along each axis,
 * the centre is 0; water is where n.x < alpha, so n points out of it. n may have any size and
 * signs, and components that are 0. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_PLANE_H
#define FV_PLANE_H

/* Share of the cell that is water, 0 to 1. dim 1 to 3. */
double plane_share(int dim, const double *n, double alpha);
/* The inverse: alpha of the plane with normal n below which the share lies. */
double plane_alpha(int dim, const double *n, double share);
/* Share of the cell that is water between the places lo < hi along axis a. */
double plane_slab(int dim, const double *n, double alpha, int a, double lo, double hi);

#endif
