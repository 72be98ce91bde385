/* discharge_gauge.h - a gauge of the discharge through a line or a rectangle.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* Present discharge, m^dim/s: in 2D through the line from `at' to `to' of g towards its right-hand
 * side; in 3D through the rectangle with these corners, along the axis normal to it. Collective. */
double discharge_gauge(struct sph *s, const struct scene_probe *g);
