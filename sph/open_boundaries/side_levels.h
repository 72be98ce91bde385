/* side_levels.h - inlets and outlets under a free surface (sides.h): the level of the water outside
 * of each, its hydrostatic pressure, and the velocity of an opening whose discharge is given. Where
 * velocity or discharge is given the level is that of the water inside. Where a level L is given
 * the water outside stands at L + c (u - U)/g, so that waves of shallow water leave: c = sqrt(g H),
 * u the mean velocity outwards, U its mean over the last two transits of the domain, as in
 * fv/boundary/levels.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SIDE_LEVELS_H
#define SPH_SIDE_LEVELS_H

#include "zones.h"

struct side_levels;

/* NULL: there is no free surface. Owned by the caller (FREE). */
struct side_levels *side_levels_create(const struct sph *s);
/* Computes the levels from the flow inside at s->t. Collective. */
void side_levels_update(const struct sph *s, struct side_levels *l);
/* Height over the water outside the nearest side, m, and its gradient, as zones_surface. */
void side_levels_surface(const struct sph *s, const struct side_levels *l, int n, const double *x,
                         double *phi, double *gphi);
/* Pressure, Pa, at x outside a side, its gradient gp[3], Pa/m (NULL: not wanted), and u[dim], m/s,
 * which on entry is the velocity inside and stays so where a level is given. */
void side_levels_eval(const struct sph *s, const struct side_levels *l, int side, const double *x,
                      double *u, double *p, double *gp);
/* Whether a level is given at this side, so that the velocity is that of the flow inside. */
bool side_levels_given(const struct side_levels *l, int side);
/* Level of the water outside, m against gravity. */
double side_levels_level(const struct side_levels *l, int side);
/* Restart files, written or read; false: the file has none that fit. */
bool side_levels_restart(struct side_levels *l, struct h5 *f);

#endif
