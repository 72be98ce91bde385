/* pressure.h - the 5-point (7-point) Poisson problem of the projection in hypre's Struct interface:
 * PCG with one PFMG cycle, started from what is given. Forced cells are identity rows; closed and
 * forced sides have no flux. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_PRESSURE_H
#define FV_PRESSURE_H

#include "../fv.h"

struct pressure *pressure_create(const struct fv *s);
void pressure_free(struct pressure **p);
/* Matrix and cycle of the surface as it is now. */
void pressure_rebuild(struct fv *s);
/* Lap psi = div, at most `most' iterations, until the residual is tol |div|. psi: start and result,
 * with ghosts. div: local cells; its mean over the free cells is taken out. Returns the iterations.
 */
int pressure_solve(const struct fv *s, double *psi, double *div, double tol, int most);
/* x ~ (shift - Lap)^-1 r by one cycle, a linear map of r (both local cells, 0 in forced ones); with
 * shift 0 means over the free cells are taken out of r and x. Returns the number of cycles. */
int pressure_cycle(const struct fv *s, double *r, double *x);
/* Sets the cycle's shift, 1/m^2; 0 at the start. */
void pressure_shift(const struct fv *s, double shift);

#endif
