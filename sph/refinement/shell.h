/* shell.h - the distance from the surface of a body or a wall, in 2D and 3D: what lies within an
 * offset of it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SHELL_H
#define SPH_SHELL_H

#include "../../common/scene/scene.h"
#include "../rigid/sph_rigid.h"

/* The surface in the frame of the start, and the pose it has moved to. In 2D each segment is two
 * triangles of a strip so wide that its rims are never nearest. */
struct shell {
    int dim;
    struct trimesh *mesh; /* NULL: the tree is the scene's */
    struct tree *tree;
    double lo[3], hi[3]; /* m: bounds at the start */
    double centre[3];    /* m: of rotation at the start */
    double x[3], Q[3][3];
};

/* Of a body or a wall of the scene that has points or a mesh; reach: the largest distance that will
 * be asked for, m. Freed by shell_free. */
struct shell shell_create(const struct scene *s, enum mesh_owner owner, int index, double reach);
void shell_free(struct shell *s);
void shell_move(struct shell *s, const struct body_motion *now);
/* Distance of x from the surface, on either side, m; beyond reach some value between that and
 * it. */
double shell_distance(const struct shell *s, const double *x, double reach);

#endif
