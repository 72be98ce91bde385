/* fv_case.h - a run from its case: faults of the case, the state at the start or from a restart
 * file. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_CASE_H
#define FV_CASE_H

#include "../fv.h"

/* fv_params.c */
void fv_params_check(const struct run *r, struct faults *f);

/* fv_unused.c: faults of keys that this run does not use. */
void fv_unused_check(const struct run *r, struct faults *f);
/* fv_scene.c: faults of a scene on a grid of cells that contradicts itself. */
void fv_scene_check(const struct run *r, struct faults *f);
/* The same of its free surface alone, on any grid. */
void surface_check(const struct run *r, struct faults *f);
/* hanging_water.c: of water that would hang from the side of the domain above it. */
void surface_check_hanging(const struct run *r, struct faults *f);

/* fv_state.c, mesh_state.c */
struct fv *fv_create(struct run *r, struct h5 *f);
void fv_free(struct fv **s);
/* What blocks add to fv_create and fv_free. */
void mesh_state_create(struct fv *s);
void mesh_state_start(struct fv *s);
void mesh_state_free(struct fv *s);
/* shape_velocity.c: adds to u what the scene's shapes do, the mean over a cell of edges h (m)
 * around x, or over a face, whose h is 0 across it; h NULL: at x. Nothing where fv has a surface.
 */
void fv_shape_velocity(const struct fv *s, const double *x, const double *h, double *u);
/* After u and U have been set: ghosts, limits, the pressure that goes with them. */
void fv_start(struct fv *s);

#endif
