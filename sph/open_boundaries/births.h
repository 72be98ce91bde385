/* births.h - one step at the open sides of openings.h: particles that left are removed, the fluxes
 * through the faces are accumulated, and particles are created.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BIRTHS_H
#define SPH_BIRTHS_H

#include "../sph.h"

/* After a step of dt, s: removal, fluxes at s->t - dt/2, creation. Lists do not hold any longer.
 * Collective. */
void births_step(struct sph *s, double dt);

#endif
