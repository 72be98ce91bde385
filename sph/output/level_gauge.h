/* level_gauge.h - height of the water's surface over a place. SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef SPH_LEVEL_GAUGE_H
#define SPH_LEVEL_GAUGE_H

#include "../sph.h"

/* m, against gravity. Collective. */
double level_gauge(struct sph *s, const double *at);

#endif
