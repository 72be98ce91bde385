/* crossing.h - coupled jobs whose free surface crosses open sides of SPH's box. Both programs then
 * hold a part of the surface, and their pressures share one reference, 0 on the surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "program.h"

/* Sets box = lower and upper corner, m, of a group of particles ("sph"): its key box, or else free.
 * false: it has neither, box is untouched. Collective over r->comm. */
bool crossing_box(const struct run *r, const char *group, double box[2][3]);
/* Whether this is such a job. Decided from the case alone, so that both programs find the same: the
 * water has a free surface, gravity acts along some axis that is not periodic, and a box of
 * particles (sph.box or sph.free, sph_left.box ...) ends inside the domain across another axis, or
 * below its top. Collective over r->comm. */
bool crossing_find(const struct run *r);
/* Deals out the gauges of the scene to the programs of a coupled job: r->gauge_elsewhere. SPH reads
 * those in its box at the start and those of bodies, FV those outside; a gauge of the surface's
 * level counts by its horizontal position where a surface crosses, unless the box ends below the
 * water there or where crests come, else it is SPH's. Gauges of points are read by both where a box
 * moves under no surface. A discharge is read by the program in whose part its whole section lies;
 * a fault is added where there is none. Collective over r->comm. */
void crossing_deal(struct run *r, struct faults *f);
/* Depth of the water at the start, m: from the domain's floor to the highest point of the fluid's
 * shapes, or to initial.level, against gravity along axis a. */
double crossing_depth(const struct scene *c, int a);
/* sqrt(H/g) with that depth H, s: a long wave takes this time over a distance of one depth.
 * INFINITY where gravity acts along periodic axes alone, or not at all. */
double crossing_time(const struct scene *c);
