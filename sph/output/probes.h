/* probes.h - gauges and the forces on bodies: columns of series.csv.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"
#include "../walls/sph_walls.h"

/* Adds the columns of gauges, of the forces on bodies, then of their motion; needs prim and slope
 * of the present state. Collective, as the next two. */
void probes_row(struct sph *s, struct figures *to);
/* Once for each row, after it: means that the summary has. */
void probes_sample(struct sph *s);
/* Force of the fluid on body k and its moment about the centre: the momentum that went there in the
 * last step (forces.h); before the first step by body_average. Collective. */
struct force probes_force(struct sph *s, int k);
