/* poisson.h - the pressure of blocks, by the back end that suits them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_POISSON_H
#define FV_POISSON_H

#include "../fv.h"
#include "../grid/mesh.h"

/* Takes the first back end that can: PFMG, BoomerAMG. Again when cells or metrics have changed. */
void poisson_create(struct fv *s);
void poisson_free(struct poisson **p);
const char *poisson_name(const struct poisson *p);
/* A psi = -div/tau; div (m^dim/s) with what the overlap makes taken out evenly. start: kept for the
 * next solve. false: did not converge. */
bool poisson_solve(struct fv *s, double tau, const double *div, double tol, double *start,
                   double *psi);
/* psi ~ the solution of (A + shift V) psi = div (both over the cells of this rank) by one cycle, a
 * linear map; without a shift and where no side gives the pressure, without its mean. */
void poisson_cycle(struct fv *s, const double *div, double *psi);
/* After blocks have moved: the matrix of the cells and of m->fringes now; without `hierarchy' the
 * one of a matrix before goes on as preconditioner. */
void poisson_renew(struct fv *s, bool hierarchy);
/* 1/m^2; 0 at the start. */
void poisson_shift(struct fv *s, double shift);

#endif
