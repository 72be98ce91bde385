/* births.h - removals, fluxes and births at the open sides of openings.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BIRTHS_H
#define SPH_BIRTHS_H

#include "../sph.h"

/* Removal, fluxes at s->t - dt/2, births. Collective. */
void births_step(struct sph *s, double dt);

#endif
