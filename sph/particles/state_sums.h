/* state_sums.h - mass, volume, energy and momentum of the state, and its vorticity.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_STATE_SUMS_H
#define SPH_STATE_SUMS_H

struct sph;

enum { SUM_MASS, SUM_VOLUME, SUM_KINETIC, SUM_ENERGY, SUM_MOMENTUM, SUM_COUNT = SUM_MOMENTUM + 3 };
/* Sums over all particles of all ranks: kg, m^dim, J, J (kinetic, elastic, potential), kg m/s. */
void sph_sums(const struct sph *s, double sums[SUM_COUNT]);
/* J of one row of the state: all kinds, and the kinetic one. */
double sph_energy(const struct sph *s, const double *y, double *kinetic);
/* Curl of u of a local particle, 1/s; needs slope of the present state. In 2D w[2] only. */
void sph_vorticity(const struct sph *s, int i, double w[3]);

#endif
