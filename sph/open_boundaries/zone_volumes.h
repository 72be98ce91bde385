/* zone_volumes.h - corrects volumes near open sides for the actual packing.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_ZONE_VOLUMES_H
#define SPH_ZONE_VOLUMES_H

#include "../sph.h"

/* After a step of dt, s: relaxes the volumes of particles between one support from the open sides
 * and the free zone towards those of a lattice, at the same velocity and density; not under a free
 * surface. Needs the lists and packed records of the last stage. */
void zone_volumes_step(struct sph *s, double dt);

#endif
