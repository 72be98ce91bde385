/* wall_cover3.h - removes from a side of the domain what lies behind meshes at rest, in 3D, such as
 * the floor under a slope that is drawn into a tank.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_COVER3_H
#define SPH_WALL_COVER3_H

#include "../../common/geometry/geometry.h"

/* A plane rectangle normal to an axis, its normal towards +axis if high; m. */
struct cover_side {
    int axis;
    bool high;
    double at, lo[3], hi[3];
};

/* The side's triangles without what lies behind the n meshes; two if nothing does. Where it meets a
 * mesh it is cut by the plane of the mesh there, in squares of at most `size', m. Owned by the
 * caller. */
struct trimesh wall_cover_side(const struct cover_side *is, int n, const struct tree *const *mesh,
                               double size);

#endif
