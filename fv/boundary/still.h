/* still.h - pressure: what gravity makes of it at rest is no part of the equations.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_STILL_H
#define FV_STILL_H

#include "../fv.h"

/* Pressure at s->t, in Pa. */
double fv_pressure(const struct fv *s, int64_t c);
/* What gravity adds to it at x: the equations hold only the rest, so that water at rest stays so.
 */
double fv_still_pressure(const struct fv *s, const double *x);
/* The part of it that the exact solution's pressure holds, too: all of it in a wave, else 0. */
double fv_still_in_exact(const struct fv *s, const double *x);

struct gravity still_split(const struct scene *scene);
/* Axis along which the gravity that the pressure takes up is strongest; without any the last. */
int still_upright(const struct scene *scene);
/* Whether it is neither along an axis nor across all others. */
bool still_leans(const double still[3]);
/* nu/(h sqrt(g h)): how fast viscosity nu moves water over h (m), over how fast gravity does;
 * infinite without one. */
double still_creep(const double still[3], double nu, double h);
#define STILL_CREEPS 10.0 /* above: it creeps */
/* That pressure at x, Pa. */
double still_pressure(const struct scene *scene, const struct gravity *g, const double *x);

#endif
