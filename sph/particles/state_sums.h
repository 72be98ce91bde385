/* state_sums.h - mass, volume, energy and momentum of the state, and its vorticity.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

struct sph;

/* Places of the sums in sums[SUM_COUNT]. */
enum { SUM_MASS, SUM_VOLUME, SUM_KINETIC, SUM_ENERGY, SUM_MOMENTUM, SUM_COUNT = SUM_MOMENTUM + 3 };
/* Sums over all particles of all levels and ranks, each by its share (particles_share): kg, m^dim,
 * J (kinetic), J (kinetic, elastic and potential), kg m/s. Collective. */
void sph_sums(const struct sph *s, double sums[SUM_COUNT]);
/* Energy of one record y of the state, J: kinetic, elastic (the integral of p/rho^2 from rho0) and
 * potential in gravity along axes that are not periodic and in the central force; *kinetic is the
 * first part. */
double sph_energy(const struct sph *s, const double *y, double *kinetic);
/* Curl of u of local particle i, 1/s, from slope, which must be of the present state. In 2D w[2]
 * only, the others are 0. */
void sph_vorticity(const struct sph *s, int i, double w[3]);
