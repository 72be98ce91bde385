/* level_gauge.h - a gauge of the water's level over a point.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* Height of the surface above the point at[3], m, against gravity on the axis along which that
 * mostly points (the last axis without gravity). Collective. */
double level_gauge(struct sph *s, const double *at);
