/* viscous_single.h - the implicit viscous solve of periodic uniform cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_VISCOUS_SINGLE_H
#define FV_VISCOUS_SINGLE_H

#include <stdbool.h>

struct helmholtz;

/* As helmholtz_cg for the operator nu Lap of uniform cells between periodic sides, imposed cells
 * left out: h->largest must bound its eigenvalues, s->viscous->single is its scratch. The increment
 * is sought in single precision, its residual is right to `goal' in double. Collective. */
bool viscous_single_cg(const struct helmholtz *h, double *const delta[3], double *const r[3],
                       double rr, double goal);

#endif
