/* plane.h - the water below a plane in a cell. Coordinates in a cell run from -1/2 to 1/2 along
 * each axis; water is where n.x < alpha, so n points out of it. n may have any size and signs, and
 * components that are 0.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_PLANE_H
#define FV_PLANE_H

/* Fraction of the cell that is water, 0 to 1, in dim = 1 to 3 dimensions. */
double plane_share(int dim, const double *n, double alpha);
/* The inverse: alpha of the plane with normal n below which that fraction lies. */
double plane_alpha(int dim, const double *n, double share);
/* Volume of water, as a fraction of the cell, between the coordinates lo < hi along axis a. */
double plane_slab(int dim, const double *n, double alpha, int a, double lo, double hi);

#endif
