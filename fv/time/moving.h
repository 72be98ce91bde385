/* moving.h - steps of blocks that move. What cells are is found once a step, for the middle of it;
 * blocks stand at each stage's own time, where donors are found anew. The pressure goes with the
 * cells: psi in the fringe is what its donors have less what p there has, see moving.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MOVING_H
#define FV_MOVING_H

#include "../boundary/fv_boundary.h"
#include "../fv.h"

struct h5;

/* NULL: no block moves. */
struct moving *moving_create(struct fv *s);
void moving_free(struct fv *s);
/* m->status and s->free, of what the blocks' cells are. */
void moving_set_free(struct fv *s);
/* What the cells are in the step of s->step.dt_now that begins; values of new ones. */
void moving_begin(struct fv *s);
/* The same with a free surface, ahead of its first half step of dt. */
void moving_begin_surface(struct fv *s, double dt);
/* With bdf2 and newton, whose surface goes ahead to where the step ends and blocks with it: the
 * matrix interpolates psi there; and back to the start's places for bdf2's convection. */
void moving_end_rows(struct fv *s);
void moving_to_start(struct fv *s);
/* newton: what the cells are where a step of dt ends, values of new ones; u, p and u_old are those
 * of its start. */
void moving_begin_implicit(struct fv *s, double dt);
/* Back to what cells were at the start of the step, where they stood then. */
void moving_back(struct fv *s);
/* step_p in the fringe, before the blocks move. */
void moving_gradient(struct fv *s);
/* u*, ahead of its projection, in the fringe. */
void moving_fill(struct fv *s, double *const u[3]);
/* The gradient of the step's pressure turns with the cells, to a stage of length tau. */
void moving_turn_pressure(struct fv *s, double tau);
/* bdf2: cells without a convection of the step before. */
void moving_convection(struct fv *s, double *const N[3]);
/* Blocks, walls and donors at the time of a stage. */
void moving_stage(struct fv *s, double t);
/* s->fringe.delta of a stage. */
void moving_change(struct fv *s);
void moving_end(struct fv *s);
/* Cells that moving blocks pass a second now or within a step, 1/s. */
double moving_rate(const struct fv *s);
void moving_save(const struct fv *s, struct h5 *f);
bool moving_restore(struct fv *s, struct h5 *f);

#endif
