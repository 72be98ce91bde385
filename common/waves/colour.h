/* colour.h - how high a place stands over the surface of water, from the share of a kernel around
 * it that the water fills ("colour"): F of the height over a plane surface, turned round. 1/2
 * stands on a plane surface by symmetry, so nothing is to be calibrated; of distances to particles
 * that cannot be said. Kernel: Wendland C2. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_COLOUR_H
#define COMMON_COLOUR_H

/* F at s/R from -1 to 1, in equal steps; its place in a table of COLOUR_PARTS + 1. */
enum { COLOUR_PARTS = 400 };
void colour_profile(int dim, double *table);
/* Height over the plane (m) at that share; beyond 0.7 R, where the kernel has next to nothing,
 * +-0.7 R. */
double colour_height(const double *table, double R, double share);
/* The largest height that it returns, m. */
double colour_reach(double R);

#endif
