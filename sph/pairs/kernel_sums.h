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
/* The viscosity of pairs, Pa s: rho0 nu over the second moment sum w (-W'/r) r^2/D that scales
 * their friction. It would be 1 but for the quadrature: on a lattice it is 0.9992 in 2D with R = 4
 * dx, 0.997 with 3, 0.967 with 2.5, in a disordered set 0.998, 0.993, 0.976. That of the present
 * list where it is known, else a lattice's. */
double kernel_pair_viscosity(const struct sph *s);
/* Whether the first pass is to sum it up: once a list, for what is viscous and has no surface. */
static inline bool kernel_moment_asked(const struct sph *s)
{
    return s->nu > 0.0 && !s->surface && s->lists.moment == 0.0;
}
/* Adds the second moment of particle i to the mean, unless a wall or an open side cuts its support,
 * or it is a guard. */
void kernel_moment_add(struct sph *s, int i, double moment);
/* After the first pass: the mean of all ranks, a lattice's where there are none, becomes that of
 * this list. Collective. */
void kernel_moment_learn(struct sph *s);

#endif
