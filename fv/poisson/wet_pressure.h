/* wet_pressure.h - the pressure of blocks under a free surface; a matrix for each place of it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_WET_PRESSURE_H
#define FV_WET_PRESSURE_H

#include "../fv.h"

void wet_pressure_create(struct fv *s);
void wet_pressure_free(struct wet_pressure **p);
/* After the rows of the fringe (m->fringes) have changed. */
void wet_pressure_donors(struct fv *s);
/* The matrix of the present cuts. */
void wet_pressure_rebuild(struct fv *s);
/* psi, from where it is, for fluxes whose divergence is div (m^dim/s, is changed); tol of the
 * residual of its start. false: not converged. */
bool wet_pressure_solve(struct fv *s, double tau, double *div, double tol, double *psi);

/* psi ~ the solution of A psi = div (m^dim/s) with nothing on the surface, by one cycle: a linear
 * map. */
void wet_pressure_cycle(struct fv *s, const double *div, double *psi);

#endif
