/* beach.h - beaches (common/scene/scene_beach.h): what they take from the velocities.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_BEACH_H
#define FV_BEACH_H

#include "../fv.h"

/* After a step of dt: velocities, and those that the next step looks back at, relax to rest before
 * sides with a beach; ghosts follow. The next projection makes their fluxes. */
void beach_relax(struct fv *s, double dt);

#endif
