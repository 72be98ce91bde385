/* box_tracking.h - a box of particles that follows a breaking wave, keeping its crest inside
 * (sph.box_follows = "breaker").
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BOX_TRACKING_H
#define SPH_BOX_TRACKING_H

#include "../sph.h"

/* The value of sph.box_follows that asks for it. */
#define BOX_TRACKING "breaker"

/* Largest speed of the box, m/s: sqrt(g H) with the height H of the domain; 0 without gravity. */
double box_tracking_speed(const struct run *r);
/* Adds the box's displacement in a step of dt, s, to way[3], m, along the axes that `along' names.
 * Collective. */
void box_tracking_step(struct sph *s, double dt, const bool along[3], double way[3]);

#endif
