/* shell.h - the distance from the surface of a body or a wall, in 2D and 3D: what lies within an
 * offset of it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SHELL_H
#define SPH_SHELL_H

#include "../../common/scene/scene.h"
#include "../rigid/sph_rigid.h"

struct shell_line;
/* A run of segments of a line, 2D. */
struct shell_run {
    double lo[2], hi[2]; /* m: their bounds */
};

/* The surface in the frame of the start, and the pose it has moved to. */
struct shell {
    int dim, nlines;
    struct shell_line *line; /* [nlines]; 2D */
    struct shell_run *run;
    const struct tree *tree; /* of the scene's mesh; NULL: it has lines */
    double lo[3], hi[3];     /* m: bounds at the start */
    double centre[3];        /* m: of rotation at the start */
    double x[3], Q[3][3];
};

/* Of a body or a wall of the scene that has points or a mesh; its arrays belong to `owner'. */
struct shell shell_create(void *owner, const struct scene *s, enum mesh_owner kind, int index);
/* Takes the surface to where its body is now; NULL: to the start. */
void shell_move(struct shell *s, const struct body_motion *now);
/* Distance of x from the surface, on either side, m; beyond reach some value between that and
 * it. */
double shell_distance(const struct shell *s, const double *x, double reach);

#endif
