/* picture_section.h - what picture.c draws of a scene with meshes.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "exact.h"
#include "scene_mesh.h"

/* Mean coordinate of the fluid along an axis, m; the middle of the domain if there is no fluid. */
double picture_water_middle(const struct scene *s, int axis);
/* Whether two neighbouring triangles enclose more than 30 degrees, so that their edge is drawn. */
bool picture_is_sharp(const struct trimesh *m, int a, int b);
