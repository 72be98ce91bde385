/* zone_volumes.h - volumes near open sides follow the packing.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_ZONE_VOLUMES_H
#define SPH_ZONE_VOLUMES_H

#include "../sph.h"

/* After a step of dt: draws the volumes of particles between a support from the open sides and the
 * free zone towards those of a lattice, at the same velocity and density; not under a free surface.
 * Needs the lists and lines of the last stage. */
void zone_volumes_step(struct sph *s, double dt);

#endif
