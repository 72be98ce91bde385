/* box_motion.h - the position of sph.box as a function of time: where it is at the start plus a
 * displacement, `way', given by a velocity, by a body that it follows, or by box_tracking.h.
 * zones->speed is the velocity over the last step, relative to which the faces see the flow.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BOX_MOTION_H
#define SPH_BOX_MOTION_H

#include "../sph.h"

/* The key that moves the box, for messages. Static memory. */
const char *box_motion_key(const struct sph_params *prm);
/* Whether the case moves its box; box_motion_along: along axis a. */
bool box_motion_wanted(const struct sph_params *prm);
bool box_motion_along(const struct run *r, const struct sph_params *prm, int a);
/* Sets `way' at time t, s, as far as it is known beforehand: for a velocity, or a driven body.
 * false: it is not. */
bool box_motion_foretold(const struct run *r, const struct sph_params *prm, double t,
                         double way[3]);
/* Largest speed of the box to expect, m/s; of one that is not known beforehand, as for a body that
 * moves as fast as the flow. */
double box_motion_speed(const struct run *r, const struct sph_params *prm);
/* Moves region, zones, faces and partition to s->t, dt, s, after they were moved last. Fills d
 * where the box comes to a side of the domain. Collective. */
void box_motion_step(struct sph *s, double dt, struct diagnosis *d);
/* Moves them by the displacement that a restart file has. */
void box_motion_set(struct sph *s, const double way[3]);
/* The region extended by as far as the box may come, m, for walls, which are laid out once. */
void box_motion_range(const struct sph *s, double lo[3], double hi[3]);

#endif
