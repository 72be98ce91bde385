/* zone_pull.h - what zones before sides, which make waves or absorb them (scene/wave_zones.h), add
 * to the rates of a stage. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_ZONE_PULL_H
#define SPH_ZONE_PULL_H

#include "../sph.h"

/* Adds the zones' force to the momentum's rates of this level's particles, its reaction to the
 * forces on the walls at rest, and the work of zones that make waves to the watch's wall_power.
 * Needs prim, and s->wave_zones. Local. */
void zone_pull_add(struct sph *s);

#endif
