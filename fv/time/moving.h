/* moving.h - steps of blocks that move. What cells are is found once a step, for the middle of it;
 * blocks stand at each stage's own time, where donors are found anew. The pressure goes with the
 * cells: psi in the fringe is what its donors have less what p there has, see moving.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MOVING_H
#define FV_MOVING_H

#include "../boundary/fv_boundary.h"
#include "../fv.h"

struct h5;

/* s->moving and the arrays of s->fringe; freed by FREE. NULL: no block moves, and then no
 * other function here may be called but moving_save and moving_restore. All are
 * collective over s->comm. */
struct moving *moving_create(struct fv *s);
/* Sets s->m->status and s->free of this rank's cells from the status of the blocks' cells. */
void moving_set_free(struct fv *s);
/* Begins a step of s->step.dt_now: cuts the blocks where they overlap in the middle of the step,
 * and gives cells that become computed or fringe their values. */
void moving_begin(struct fv *s);
/* The same with a free surface, before its first half step; dt, s, becomes s->step.dt_now. */
void moving_begin_surface(struct fv *s, double dt);
/* Begins a step: at its end motions have the velocity of before, if one starts or ends there.
 * Whether one does at its start, where walls have the velocity of after now. */
bool moving_turns(struct fv *s);
/* With bdf2 and newton, whose surface goes ahead to where the step ends and blocks with it: makes
 * the matrix interpolate psi in the fringe by the donors of that time. */
void moving_end_rows(struct fv *s);
/* Before convection: puts blocks, donors and the fluxes of walls back to the step's start, from
 * where the surface is in rk3 (half time) and bdf2. */
void moving_to_start(struct fv *s);
/* newton: cuts the blocks where a step of dt, s, ends and gives new cells their values in u, p and
 * stages.u_old, which are those of its start. */
void moving_begin_implicit(struct fv *s, double dt);
/* Takes a step back: puts blocks, donors and the status of cells back to its start. */
void moving_back(struct fv *s);
/* Interpolates stages.step_p in the fringe and keeps it, before the blocks move. */
void moving_gradient(struct fv *s);
/* Sets u* ahead of its projection in the fringe and the ghosts: interpolated, plus what its
 * gradient of psi differs by from that of the donors (head of moving.c). */
void moving_fill(struct fv *s, double *const u[3]);
/* Turns stages.step_p with the cells to the time that the pressure of a stage of length tau, s,
 * stands for. */
void moving_turn_pressure(struct fv *s, double tau);
/* bdf2: sets the convection of the step before to N in cells that were not computed then. */
void moving_convection(struct fv *s, double *const N[3]);
/* Puts blocks where they are at the time t, s, of a stage, finds donors there, and sets
 * s->fringe.psi. */
void moving_stage(struct fv *s, double t);
/* Sets s->fringe.delta of a stage: what the viscous increment in the fringe has beyond its
 * interpolation. */
void moving_change(struct fv *s);
/* Ends a step: decides by the iterations of its solves whether the next one makes the hierarchy of
 * the pressure solver anew. */
void moving_end(struct fv *s);
/* Cells that moving blocks pass a second now or within a step, 1/s. */
double moving_rate(const struct fv *s);
/* Writes what the next step needs to a restart file; nothing without moving blocks. */
void moving_save(const struct fv *s, struct h5 *f);
/* Reads it back and puts blocks, cells and donors where the last step ended; false: the file does
 * not have it. */
bool moving_restore(struct fv *s, struct h5 *f);

#endif
