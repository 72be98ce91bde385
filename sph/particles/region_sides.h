/* region_sides.h - sides of the region where fluid comes and goes, and gauges near them.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* Whether fluid comes or goes by an opening in a side of the region (2a: low, 2a+1: high). */
bool region_side_opens(const struct sph *s, int side);
/* Whether nothing holds fluid back at it: there is an opening or, as far as sides go, no wall. */
bool region_side_passes(const struct sph *s, int side);
/* Coordinate x along axis a, m, where a gauge that sums volumes is read: x, but at least 3 dx
 * inside sides of which `is' is true, clear of the rows that are born and removed there. x outside
 * of the region is left alone. */
double region_clear(const struct sph *s, int a, double x, bool (*is)(const struct sph *, int));
