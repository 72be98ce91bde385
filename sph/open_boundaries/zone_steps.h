/* zone_steps.h - what is done in the zones of zones.h within a step, and what they save.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_ZONE_STEPS_H
#define SPH_ZONE_STEPS_H

#include "zones.h"

/* The zones of level s if its region has open sides, else NULL. Owned by the caller
 * (FREE). */
struct zones *zones_create(struct sph *s);
/* Start of a stage: buffer particles take u and p of the outer solution at s->t; m = rho w.
 * Collective. */
void zones_stage(struct sph *s);
/* After the gradients of a stage: slopes of buffer particles from the outer solution; transport
 * velocity near the open sides. */
void zones_slopes(struct sph *s);
/* Mass of all particles of the region, kg. Collective. */
double zones_mass(const struct sph *s);
/* At an exchange with a partner: under a surface sets the reference pressure by the mass of the
 * region, otherwise lets out what it gained. Collective. */
void zones_gauge(struct sph *s);
/* After the stages: in transition particles the velocity along the side and the characteristic p -
 * rho c u.n that enters (n outwards) are relaxed towards the outer solution [6.8], fully at the
 * buffer, not at all at the free zone. What leaves, p + rho c u.n, is SPH's own. */
void zones_blend(struct sph *s);
/* After positions, and the box with them, moved by a step of dt, s: removals, fluxes of the faces,
 * creations [6.13-6.14]. Lists and slopes do not hold any longer. Collective. */
void zones_openings(struct sph *s, double dt);
/* Restart files, written or read; false: the file has none that fit. */
bool zones_restart(struct sph *s, struct h5 *f);

#endif
