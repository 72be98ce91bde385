/* shore.h - the gauge of a shoreline: where the water ends on a beach.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* Height of the ground at the edge of the water, m, in 2D with gravity along -y: from x to both
 * sides through columns that hold half a layer of particles at least; of two edges the higher one.
 * NAN: no edge before the ends of the region, or no water at x. Collective. */
double shore_height(struct sph *s, double x);
