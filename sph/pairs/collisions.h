/* collisions.h - pairs that run into each other. The kernel's gradient is 0 between two particles
 * at one place: nothing in the pair sums keeps them from getting there, and nothing parts them
 * again. Two that approach within dx/2 exchange momentum as in a collision (Koshizuka, Tamako &
 * Oka, Comput. Fluid Dyn. J. 4, 1995; Lee et al., Comput. Methods Appl. Mech. Eng. 200, 2011), half
 * of their approach a step, so that one that meets several at once is not thrown back; below dx/5
 * they are moved apart. Momentum is kept; what they exchange loses kinetic energy, what moves them
 * apart may compress them a little. Flows that keep their particles apart have none.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_COLLISIONS_H
#define SPH_COLLISIONS_H

#include "../sph.h"

/* m: pairs nearer than this may collide; 0: none ever do. */
double collisions_distance(const struct sph *s);
/* After the stages of a step, by the lines of the last: every pair is seen alike by both its ranks.
 */
void collisions_apply(struct sph *s);

#endif
