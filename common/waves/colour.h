/* colour.h - the height of a point over a water surface from the fraction of the kernel around it
 * that the water fills (its "colour"). F is that fraction as a function of the height over a plane
 * surface; a table of F is inverted. A fraction of 1/2 is on a plane surface by symmetry, so that
 * nothing has to be calibrated, which cannot be said of distances to particles. Kernel: Wendland
 * C2.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_COLOUR_H
#define COMMON_COLOUR_H

/* Fills table[COLOUR_PARTS + 1] with F at equal steps of height/R from -1 to 1, in dim = 2 or 3
 * dimensions. */
enum { COLOUR_PARTS = 400 };
void colour_profile(int dim, double *table);
/* Height over the plane, m, at which F is `share', for a kernel of support R, m; limited to +-0.7
 * R, beyond which the kernel has next to no weight. */
double colour_height(const double *table, double R, double share);
/* That limit, 0.7 R, m. */
double colour_reach(double R);

#endif
