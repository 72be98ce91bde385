/* picture_section.h - cuts a plane through a scene with meshes; for picture.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_PICTURE_SECTION_H
#define COMMON_PICTURE_SECTION_H

#include "exact.h"
#include "scene_mesh.h"

/* Mean coordinate of the fluid along an axis, m; the middle of the domain if there is no fluid. */
double picture_water_middle(const struct scene *s, int axis);
/* Sets x to the ends of the segment in which a triangle crosses the plane x_axis = cut, m; false:
 * it does not. */
bool picture_cut(const struct trimesh *m, int triangle, int axis, double cut, double x[2][3]);
/* Whether two neighbouring triangles enclose more than 30 degrees, so that their edge is drawn. */
bool picture_is_sharp(const struct trimesh *m, int a, int b);

#endif
