/* wave_outside.h - a wave of permanent form (initial.field = "regular" or "solitary") as the flow
 * outside a region of particles whose open sides its surface crosses (sph.outer = "exact"). The
 * context of both functions is a struct exact. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WAVE_OUTSIDE_H
#define SPH_WAVE_OUTSIDE_H

#include "zones.h"

/* Whether the case has such a wave around the region, with a surface. */
bool wave_outside_wanted(const struct run *r, const struct sph_params *prm);
zones_eval wave_outside_eval;       /* gradients by central differences */
zones_surface wave_outside_surface; /* distance to the surface's tangent over x */

#endif
