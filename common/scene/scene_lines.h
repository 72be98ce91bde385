/* scene_lines.h - polylines of walls in the plane: which of their sides is the fluid's, and what
 * open ones leave out behind them. Local to a rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

/* Whether the points of wall k, a polyline, must be reversed to have the fluid on their left. */
bool scene_line_is_reversed(const struct scene *s, int k);
/* Whether body k is a tank: in a plane scene without walls or a field all water of the shapes is
 * inside its points. */
bool scene_body_is_tank(const struct scene *s, int k);
/* Whether some wall is an open polyline. */
bool scene_has_open_lines(const struct scene *s);
/* Whether the nearest of the open polylines has x, m, on its right, where no fluid is. A line
 * continues straight beyond an end on a side of the domain; beyond another end nothing is behind
 * it. */
bool scene_is_behind_lines(const struct scene *s, const double *x);
