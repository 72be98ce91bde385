/* box_motion.h - the place of sph.box as a function of time: its place at the start and a way, told
 * by a velocity or gone with a body. A step leaves it with the velocity that it had over the step:
 * faces see the flow relative to that. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BOX_MOTION_H
#define SPH_BOX_MOTION_H

#include "../sph.h"

/* The key that moves the box, for messages. */
const char *box_motion_key(const struct sph_params *prm);
/* Whether the case moves its box; along axis a. */
bool box_motion_wanted(const struct sph_params *prm);
bool box_motion_along(const struct run *r, const struct sph_params *prm, int a);
/* m: the way at time t as far as it is known beforehand: of a velocity, or of a driven body. */
bool box_motion_foretold(const struct run *r, const struct sph_params *prm, double t,
                         double way[3]);
/* m/s: largest speed of the box to expect, of one whose way is foretold; else of a body that goes
 * as fast as the flow does. */
double box_motion_speed(const struct run *r, const struct sph_params *prm);
/* Moves region, zones, faces and partition to s->t, dt after they were moved last. d: filled where
 * the box comes to a side of the domain. */
void box_motion_step(struct sph *s, double dt, struct diagnosis *d);
/* Puts them where the way says that a restart file has. */
void box_motion_set(struct sph *s, const double way[3]);
/* The region as far as the box may come, for what is laid out once: walls. */
void box_motion_range(const struct sph *s, double lo[3], double hi[3]);

#endif
