/* box_chase.h - a box of particles that goes with a breaker: with the crest in it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BOX_CHASE_H
#define SPH_BOX_CHASE_H

#include "../sph.h"

/* sph.box_follows = BOX_CHASE. */
#define BOX_CHASE "breaker"

/* m/s: the most that the box goes; 0 without gravity. */
double box_chase_speed(const struct run *r);
/* Adds the way of a step to way[3] along the axes that `along' names. Collective. */
void box_chase_step(struct sph *s, double dt, const bool along[3], double way[3]);

#endif
