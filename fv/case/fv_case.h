/* fv_case.h - a run from its case: faults of the case, the state at the start or from a restart
 * file. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../boundary/fv_boundary.h"
#include "../fv.h"

/* fv_params.c: the groups fv, blocks and blocked of a case, for struct program. */
enum { FV_GROUPS = 3 };
extern const struct param_group fv_groups[FV_GROUPS];
/* The case's parameters with what follows from them; they last as long as the program. case/ and
 * the main program alone ask for them, all others get them. */
const struct fv_params *fv_params_of(const struct run *r);
/* Boxes that are cut out of the cells: of the list blocked, and bodies. */
int fv_params_nboxes(const struct run *r);
/* Whether the scene has a free surface that fv computes. */
bool surface_wanted(const struct run *r);
/* Adds the faults of the three groups that need more than one key. */
void fv_params_check(const struct run *r, struct faults *f);

/* fv_unused.c: whether errors against the exact solution are measured. */
bool fv_measures_errors(const struct run *r);
/* Faults of keys that this run does not use. */
void fv_unused_check(const struct run *r, struct faults *f);
/* fv_scene.c: with a free surface finds what stands in outflows, and closes the air above by a slip
 * wall on each side of the domain that gravity points away from and that the case leaves open
 * (blocks name the kinds of their sides). */
void fv_scene_complete(struct run *r);
/* Says which sides these are. */
void fv_scene_describe(const struct run *r);
/* Faults of wall k of the scene that are such on cells and on blocks: what fv does not have. */
void fv_wall_check(const struct run *r, struct faults *f, int k);
/* Faults of a scene on a grid of cells that contradicts itself. */
void fv_scene_check(const struct run *r, struct faults *f);
/* The same of its free surface alone, on any grid. */
void surface_check(const struct run *r, struct faults *f);
/* Faults of gauges of the level without a surface to read, this program's or a partner's. */
void probes_check_surface(const struct run *r, struct faults *f);
/* Why newton has no outflow outside of which nothing stands, or less than elsewhere. */
const char *surface_newton_lacks(bool falls);
/* Without a surface, on cells and on blocks: the faults of outflows at different heights, and of
 * inflows, of that group of keys, that take out net m^dim/s. */
void fv_fault_falls(const struct run *r, struct faults *f);
void fv_fault_sucks(const struct run *r, struct faults *f, const char *group, double net);
/* hanging_water.c: of water that would hang from the side of the domain above it. */
void surface_check_hanging(const struct run *r, struct faults *f);

/* mesh_params.c: the keys of a block. */
enum { MESH_ROWS = 26 };
extern const struct param mesh_rows_of[MESH_ROWS];
/* What params_read fills from them: the blocks of the case in its order, and their number. */
extern struct mesh_block_params mesh_given[MESH_BLOCKS_MAX];
extern int mesh_given_count;
/* A ring between two walls that the case calls Couette flow: its steady flow is known. */
bool mesh_ring(const struct run *r);
/* Faults of the group blocks; makes and frees the mesh. */
void mesh_check(const struct run *r, struct faults *f);
/* mesh_scene.c: faults of a scene on blocks that contradicts itself. */
void mesh_scene_check(const struct run *r, struct faults *f, const struct mesh *m);
/* Faults of blocks that move within the run: out of the domain, cells without donors; the mesh ends
 * where they end. */
void mesh_motion_sweep(const struct run *r, struct faults *f, struct mesh *m);

/* blocked_params.c: the keys of a box that is cut out of the cells. */
enum { BLOCKED_ROWS = 4 };
extern const struct param blocked_rows[BLOCKED_ROWS];
/* The boxes of the case in its order, and their number; bodies make more of them. */
extern struct blocked_params blocked_given[BLOCKED_MAX];
extern int blocked_given_count;
/* Adds the faults of the boxes of both kinds: outside of the domain, without a cell, too near to
 * each other. */
void blocked_check(const struct run *r, struct faults *f);
/* Says where boxes stand that are not made of whole cells. */
void blocked_describe(const struct run *r);

/* fv_state.c: the state at the start, or from the restart file f (not NULL). NULL on all ranks: the
 * file does not fit, which has been logged. Owned by the caller (fv_free). Collective over
 * r->comm. */
struct fv *fv_create(struct run *r, struct h5 *f);
/* Frees the state with all that it owns and sets *s to NULL; *s may be NULL. */
void fv_free(struct fv **s);
/* Allocates the fields of s->size entries that every grid needs. */
void fv_make_fields(struct fv *s);
/* mesh_state.c, the same for blocks: makes the mesh, its fields and all that stands on them, the
 * flow of the scene in them. Collective. */
void mesh_state_create(struct fv *s);
/* shape_velocity.c: adds to u what the scene's shapes do, the mean over a cell of edges h (m)
 * around x, or over a face, whose h is 0 across it. Nothing where fv has a surface. */
void fv_shape_velocity(const struct fv *s, const double *x, const double *h, double *u);
/* Projects the velocities of the start, where they need it. Collective. */
void fv_project_start(struct fv *s);
/* After u and U have been set: ghosts, limits, the pressure that goes with them. */
void fv_start(struct fv *s);
