/* kernel_sums.h - how much of its volume the fluid fills, by the kernel sum of w W.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_KERNEL_SUMS_H
#define SPH_KERNEL_SUMS_H

#include "../sph.h"

/* Sum of w W over particle i and its neighbours, -; 1 inside up to the quadrature's error. Needs
 * prim and the list of pairs. Local to the rank. */
double kernel_sum(const struct sph *s, int i);
/* The same sum over a whole lattice, which differs from 1 by the error of the quadrature: 1.0012 in
 * 2D with R = 4 dx. */
double kernel_lattice_sum(const struct sph *s);
/* The viscosity of pairs, Pa s: rho0 nu over the second moment sum dx^D (-W'/r) x_1^2 of that
 * lattice, which scales their friction and would be 1 but for the quadrature: 0.9992 in 2D with
 * R = 4 dx, 0.997 with 3, 0.967 with 2.5. */
double kernel_pair_viscosity(const struct sph *s);

#endif
