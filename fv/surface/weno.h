/* weno.h - derivatives of a level set along rows of cells, fifth order (Jiang & Peng, SIAM J. Sci.
 * Comput. 21, 2000). SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_WENO_H
#define FV_WENO_H

#include <stdint.h>

/* rate[i] -= u dq/dx from the side that the flow comes from, for n cells; d: step between
 * neighbours along the axis, per_h = 1/h (1/m). */
void weno_advect(const double *q, const double *u, int64_t d, double per_h, int64_t n,
                 double *rate);
/* sum[i] += (dq/dx)^2 from the side that distance comes from, Godunov's choice: sign[i] < 0 in the
 * water. */
void weno_add_square(const double *q, const double *sign, int64_t d, double per_h, int64_t n,
                     double *sum);
/* dq/dx from below and from above. */
void weno_slopes(const double *q, int64_t d, double per_h, int64_t n, double *below, double *above);

#endif
