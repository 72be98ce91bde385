/* pressure.h - the 5-point (7-point) Poisson problem of the projection in hypre's Struct interface:
 * PCG with one PFMG cycle, started from what is given. Forced cells are identity rows; closed and
 * forced sides have no flux. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_PRESSURE_H
#define FV_PRESSURE_H

#include "fv.h"

struct pressure *pressure_create(const struct fv *s);
void pressure_free(struct pressure **p);
/* Lap psi = div, at most `most' iterations, until the residual is tol |div|. psi: start and result,
 * with ghosts. div: local cells; its mean over the free cells is taken out. Returns the iterations.
 */
int pressure_solve(const struct fv *s, double *psi, double *div, double tol, int most);

#endif
