/* poisson.h - the pressure of the projection, by the back end that suits the cells (backend.h).
 * Imposed cells take no part in it; closed and imposed sides have no flux of psi.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_POISSON_H
#define FV_POISSON_H

#include "../fv.h"

/* Takes the first back end that can. Again when cells or metrics have changed. */
void poisson_create(struct fv *s);
void poisson_free(struct poisson **p);
const char *poisson_name(const struct poisson *p);
/* A psi = -div/tau; even cells: Lap psi = div (1/s^2). div, of flow_ops, is changed; what it lacks
 * to be compatible, where no side gives the pressure, is removed uniformly. psi: start and result,
 * with its ghosts; of blocks without a surface the start is `start', kept for the next solve.
 * false: did not converge.
 */
bool poisson_solve(struct fv *s, double tau, double *div, double tol, double *start, double *psi);
/* psi ~ the solution of (shift - Lap) psi = div (1/s) by one cycle, a linear map, with its ghosts;
 * without a shift and where no side gives the pressure, without its mean. div is changed. */
void poisson_cycle(struct fv *s, double *div, double *psi);
/* The matrix of the surface as it is now. */
void poisson_rebuild(struct fv *s);
/* After blocks have moved: the matrix of the cells and of m->fringes now (under a surface
 * poisson_rebuild makes it); without `hierarchy' the one of a matrix before goes on as
 * preconditioner. */
void poisson_renew(struct fv *s, bool hierarchy);
/* Of the cycle, 1/m^2; 0 at the start. */
void poisson_shift(struct fv *s, double shift);

#endif
