/* zone_steps.h - what is done in the zones of zones.h within a step, and what they keep.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_ZONE_STEPS_H
#define SPH_ZONE_STEPS_H

#include "zones.h"

/* Zones if the region s->lo..hi has open sides, else NULL. */
struct zones *zones_create(struct sph *s);
void zones_free(struct zones **z);
/* Start of a stage: buffer particles take u and p from outside at s->t; m = rho w. */
void zones_stage(struct sph *s);
/* After the gradients of a stage: buffer slopes from outside; transport shift near the open sides.
 */
void zones_slopes(struct sph *s);
/* kg: of all particles of the region. Collective. */
double zones_mass(const struct sph *s);
/* At an exchange with a partner: sets the gauge by the mass of the region under a surface, else
 * lets out what it gained. Collective. */
void zones_gauge(struct sph *s);
/* After the RK cycle: transition particles are blended with the outside [6.7-6.8]. */
void zones_blend(struct sph *s);
/* After the positions moved by dt, and the box with them: removals, face masses, births
 * [6.13-6.14]. Lists and slopes do not hold any longer. Collective. */
void zones_openings(struct sph *s, double dt);
void zones_save(struct sph *s, struct h5 *f);
bool zones_load(struct sph *s, struct h5 *f);

#endif
