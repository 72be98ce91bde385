/* level_gauge.h - where the water's surface is over a place. SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef SPH_LEVEL_GAUGE_H
#define SPH_LEVEL_GAUGE_H

#include "../sph.h"

/* m: its height against gravity on the axis along which that points (the last one without gravity).
 * Collective. */
double level_gauge(struct sph *s, const double *at);

#endif
