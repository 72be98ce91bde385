/* stages.h - the parts of a stage, on any grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_STAGES_H
#define FV_STAGES_H

#include "../boundary/fv_boundary.h"
#include "../operators/fv_operators.h"
#include "steps.h"

/* s->stages, all 0. */
void stage_fields_create(struct fv *s);
void stage_fields_free(struct fv *s);

/* step_p = grad p of the step's start, p without its odd-even mode. */
void stage_pressure_gradient(struct fv *s);
/* What the next projection will take off the velocity of the sides. */
void stage_set_slip(struct fv *s, double tau, const double *psi);
/* Conditions on the sides dt after outflow_begin, at t. */
void stage_set_sides(struct fv *s, double t, double dt);
void stage_convection(struct fv *s, double *const N[3]);
bool stage_solve_viscous(struct fv *s, double c, double t, double scale);
/* U of u ahead of its projection, at time t. */
void stage_predict_fluxes(struct fv *s, double t);
/* psi[stage], with ghosts, of the fluxes U; false: not converged. */
bool stage_solve_pressure(struct fv *s, int stage, double tau, double tol);

/* fv_step.c: "cell (i, j, k)", of which block; its centre. */
void cell_place(const struct fv *s, int64_t c, char *text, size_t size, double x[3]);
/* projection.c: makes u and U solenoidal; psi[stage] is the start and the result. */
void projection(struct fv *s, double t, int stage, double tau, double tol);

#endif
