/* stages.h - the parts of a stage, on any grid: an integrator is a sequence of these. A stage takes
 * the velocity from the old level by convection, pressure of the step's start and implicit
 * viscosity to u*, and projects that. All are collective over s->comm.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_STAGES_H
#define FV_STAGES_H

#include "../boundary/fv_boundary.h"
#include "../operators/fv_operators.h"
#include "steps.h"

/* Allocates the fields of s->stages that the integrator needs, all 0. */
void stage_fields_create(struct fv *s);

/* Once a step: sets stages.step_p to grad p, m/s^2, of the step's start, from p without its
 * odd-even mode. Blocks that move are cut for the step here. */
void stage_pressure_gradient(struct fv *s);
/* Sets the slip error tau grad psi of the projection of length tau, s, that u* on the sides is to
 * compensate for; psi, m^2/s^2: the estimate of it. */
void stage_set_slip(struct fv *s, double tau, const double *psi);
/* Puts moving blocks where they are at t, s, and sets the conditions on the sides for that time,
 * which is dt after outflow_begin. */
void stage_set_sides(struct fv *s, double t, double dt);
/* N = the convection of u by U, m/s^2. */
void stage_convection(struct fv *s, double *const N[3]);
/* Solves (1 - c L) delta = s->rhs, L = nu Lap, for the increment s->delta of the stage's velocity
 * at t, s; c, s: length of the implicit part. The solve may start from `scale' times the delta of
 * the stage before (0: there is none). false: not converged. */
bool stage_solve_viscous(struct fv *s, double c, double t, double scale);
/* Sets the fluxes U of u* ahead of its projection, at time t, s, with imposed cells, walls and
 * ghosts of that time. */
void stage_predict_fluxes(struct fv *s, double t);
/* psi[stage], with ghosts, of the fluxes U; false: not converged. */
bool stage_solve_pressure(struct fv *s, int stage, double tau, double tol);

/* fv_step.c: writes "cell (i, j, k)" of the whole grid, or of which block, to text[size] and its
 * centre, m, to x. */
void cell_place(const struct fv *s, int64_t c, char *text, size_t size, double x[3]);
/* projection.c: makes u and U solenoidal; psi[stage] is the start and the result. */
void projection(struct fv *s, double t, int stage, double tau, double tol);

#endif
