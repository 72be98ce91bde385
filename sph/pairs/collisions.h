/* collisions.h - pairs that run into each other. The kernel's gradient is 0 between two particles
 * at one point: nothing in the pair sums keeps them from getting there, and nothing separates them
 * again. Two that approach within dx/2 exchange momentum as in a collision (Koshizuka, Tamako &
 * Oka, Comput. Fluid Dyn. J. 4, 1995; Lee et al., Comput. Methods Appl. Mech. Eng. 200, 2011), half
 * of their approach per step, so that one that meets several at once is not thrown back; below dx/5
 * they are moved apart. Momentum is conserved; the exchange dissipates kinetic energy, and moving
 * apart may compress them a little. Flows that keep their particles apart have none.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_COLLISIONS_H
#define SPH_COLLISIONS_H

#include "../sph.h"

/* Distance below which pairs may collide, m; 0 in Eulerian runs, where particles do not move. */
double collisions_distance(const struct sph *s);
/* Applies the collisions of the pairs in list->close after the stages of a step, from the packed
 * records of the last stage. A pair across ranks is treated alike by both, each changing its own
 * particle. */
void collisions_apply(struct sph *s);

#endif
