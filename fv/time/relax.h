/* relax.h - zones before sides (common/scene/scene_waves.h): what they make of the velocities.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_RELAX_H
#define FV_RELAX_H

#include "../fv.h"

/* After a step of dt to s->t: velocities, and those that the next step looks back at, relax to rest
 * or to the waves in zones; ghosts follow. The next projection makes their fluxes. false: there are
 * none. */
bool relax_zones(struct fv *s, double dt);

#endif
