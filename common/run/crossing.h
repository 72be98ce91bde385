/* crossing.h - coupled jobs whose free surface crosses open sides of SPH's box: both programs have
 * a part of it, and of one pressure that is 0 on it. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_CROSSING_H
#define COMMON_CROSSING_H

#include "run.h"

/* The box of a group of particles (box, or else free); false: it has none. Collective over r->comm.
 */
bool crossing_box(const struct run *r, const char *group, double box[2][3]);
/* From the case alone, so that both programs say the same: the water has a surface, gravity holds
 * it down, and a box of particles (sph.box or sph.free, sph_left.box ...) ends inside the domain
 * along an axis across gravity, or below its top.
 * Collective over r->comm. */
bool crossing_find(const struct run *r);
/* Deals out the gauges of the scene: r->gauge_elsewhere. In a coupled job SPH reads those in its
 * box, at its start, and those of bodies, FV those outside; of points both where a box moves under
 * no surface. Collective over r->comm. */
void crossing_deal(struct run *r);
/* Height of the water above the domain's floor at the start, along axis a, m. */
double crossing_depth(const struct scene *c, int a);
/* sqrt(H/g) of that depth, s: what long waves take over one depth. */
double crossing_time(const struct scene *c);

#endif
