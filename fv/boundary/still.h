/* still.h - hydrostatic pressure, which is left out of the equations, so that water at rest stays
 * at rest; outputs add it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_STILL_H
#define FV_STILL_H

#include "../fv.h"

/* Pressure of cell c at s->t, Pa, without the hydrostatic part, which fv_still_pressure has. */
double fv_pressure(const struct fv *s, int64_t c);
/* The hydrostatic part at x, Pa. */
double fv_still_pressure(const struct fv *s, const double *x);
/* The part of it that the exact solution's pressure contains as well: all of it in a wave, else 0;
 * Pa. */
double fv_still_in_exact(const struct fv *s, const double *x);

/* still.c: splits gravity, m/s^2: along a periodic axis or a channel it drives the flow; across
 * closed sides a hydrostatic pressure balances it, which is 0 at the height of its level, m. */
struct gravity still_split(const struct scene *scene);
/* scene_still_axis; without gravity that is balanced the last axis. */
int still_upright(const struct scene *scene);
/* Whether it is not along an axis. */
bool still_is_inclined(const double still[3]);
/* nu/(h sqrt(g h)): how fast viscosity nu, m^2/s, moves water over h, m, over how fast gravity
 * does; 0 without viscosity, else infinite without gravity. Above STILL_CREEPS water creeps. */
double still_creep(const double still[3], double nu, double h);
#define STILL_CREEPS 10.0

#endif
