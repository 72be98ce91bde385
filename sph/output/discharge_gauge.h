/* discharge_gauge.h - what flows through a line or a rectangle now.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_DISCHARGE_GAUGE_H
#define SPH_DISCHARGE_GAUGE_H

#include "../sph.h"

/* m^dim/s: 2D through the line from at to `to', to its right-hand side; 3D through the rectangle
 * between these corners, along the axis across it. Collective. */
double discharge_gauge(struct sph *s, const struct scene_probe *g);

#endif
