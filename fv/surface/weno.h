/* weno.h - derivatives of a level set along lines of cells, fifth order (Jiang & Peng, SIAM J. Sci.
 * Comput. 21, 2000). q must have three cells beyond both ends.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_WENO_H
#define FV_WENO_H

#include <stdint.h>

/* rate[i] -= u dq/dx, upwind, for n cells; d: offset between neighbours along the axis, per_h =
 * 1/h, 1/m. */
void weno_advect(const double *q, const double *u, int64_t d, double per_h, int64_t n,
                 double *rate);
/* sum[i] += (dq/dx)^2, upwind in the sense of distance from the surface by Godunov's choice:
 * sign[i] < 0 in the water. */
void weno_add_square(const double *q, const double *sign, int64_t d, double per_h, int64_t n,
                     double *sum);
/* dq/dx biased to lower and to higher cells. */
void weno_slopes(const double *q, int64_t d, double per_h, int64_t n, double *below, double *above);

#endif
