/* picture_section.h - what a plane through a scene with meshes meets; for picture.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_PICTURE_SECTION_H
#define COMMON_PICTURE_SECTION_H

#include "exact.h"
#include "scene_mesh.h"

/* Mean place of the fluid along an axis, m; the domain's middle if there is none. */
double picture_water_middle(const struct scene *s, int axis);
/* Where a triangle crosses the plane at `cut' on an axis. */
bool picture_cut(const struct trimesh *m, int triangle, int axis, double cut, double x[2][3]);
/* Whether two neighbours meet at more than 30 degrees. */
bool picture_is_sharp(const struct trimesh *m, int a, int b);

#endif
