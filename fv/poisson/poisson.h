/* poisson.h - the pressure equation of the projection, solved by the backend that suits the cells
 * (backend.h). Imposed cells take no part in it; closed and imposed sides have no flux of psi.
 * Collective over s->comm.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../fv.h"

/* Picks the first backend that takes the cells and makes s->poisson; again when cells or metrics
 * have changed. It belongs to s. */
void poisson_create(struct fv *s);
/* Solves A psi = -div/tau, on uniform cells Lap psi = div, 1/s^2, to the relative residual tol. div
 * is that of flow_ops and is overwritten; where no side gives the pressure its compatibility defect
 * is removed uniformly. psi: start and result, with its ghosts; on blocks without a surface the
 * start is `start', which is kept for the next solve. false: not converged. */
bool poisson_solve(struct fv *s, double tau, double *div, double tol, double *start, double *psi);
/* psi ~ the solution of (shift - Lap) psi = div, 1/s, by one cycle, a linear map, with its ghosts;
 * without a shift, and where no side gives the pressure, without its mean. div is overwritten. */
void poisson_cycle(struct fv *s, double *div, double *psi);
/* Makes the matrix of the present surface. */
void poisson_rebuild(struct fv *s);
/* After blocks have moved: makes the matrix of the present cells and m->fringes (under a surface
 * poisson_rebuild does so); without `hierarchy' the multigrid hierarchy of an earlier matrix stays
 * in use as preconditioner. */
void poisson_renew(struct fv *s, bool hierarchy);
/* Sets the shift of poisson_cycle, 1/m^2; 0 at the start. */
void poisson_shift(struct fv *s, double shift);
