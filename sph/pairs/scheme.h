/* scheme.h - what a pair interaction provides. Both passes run over the list s->list with prim (and
 * slope) of locals and ghosts; dimension, viscosity and limiter are compile-time constants of one
 * body each.
 *
 * The first pass, gradients (one-sided): renormalised gradients of rho and u, and the transport
 * velocity, of every local particle into slope. The slope is zero where the moment matrix M is
 * nearly singular (smallest eigenvalue < 0.1), and full above 0.2. The second pass, rates
 * (symmetric): p.rate of every local particle from prim and slope.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SCHEME_H
#define SPH_SCHEME_H

#include "../sph.h"

/* One instance of a pass, for the members of struct scheme (sph.h). */
typedef void scheme_pass(struct sph *s);
/* The passes that the parameters of s name. */
struct scheme scheme_pick(const struct sph *s);

/* The first pass with all slopes, whatever the scheme needs of them: for output as well. */
scheme_pass *scheme_gradients(int dim, int transport);
/* The first pass with the slopes of rho alone, and u0 = u. */
scheme_pass *scheme_density_gradients(int dim);
/* The second pass of riemann_ale and riemann. */
scheme_pass *scheme_rates(const struct sph *s);
/* The same with exact Riemann problems; viscosity: enum sph_viscosity, or VISCOSITY_OFF for
 * none. */
scheme_pass *scheme_exact_rates(int dim, int scheme, int viscosity);
/* The second pass of delta and standard. */
scheme_pass *scheme_delta_rates(const struct sph *s);

/* Adds to the rates of particle i the terms of delta and standard that convect with the shift and
 * belong to no pair. */
void scheme_take_along(const struct sph *s, int i, double *rate);

/* The speed, m/s, that scales the shift of local particle i: step.shift_speed, but in the
 * transition and buffer zones at least 0.1 c0 (with walls) or 0.2 c0. Particles are created there
 * where the flow of their face carries them, beside others that do not wait for them, and the
 * disorder that they took into the free zone was most of the error there (vortices carried by (0.3,
 * -2) U in a box with the exact flow outside: velocity 0.0006 U off, with this 0.0002; the mass
 * within fluctuated by 0.5 %, now by 0.1 %). */
static inline double scheme_shift_speed(const struct sph *s, int i)
{
    const double most = (s->walls ? 0.1 : 0.2) * s->c0;
    const bool given = s->zones && !s->packing && s->p.zone[i] != ZONE_FREE;
    return given && most > s->step.shift_speed ? most : s->step.shift_speed;
}

/* What the scene says of how much the water streams: 0 and less up to 0.001 c0 of what it keeps
 * streaming, 1 from 0.002 c0 on. A stream that carries all water alike has no pressures to be erred
 * by: it is water at rest from another point of view, and goes without that order no better (a
 * level one of 0.25 m/s over edges of refinement: 11 % of its energy in 3 s). */
static inline double scheme_kept(const struct sph *s)
{
    return (1.0 - s->step.carried) * fmin(s->prm.speed.stream / (0.001 * s->c0) - 1.0, 1.0);
}

/* How much the water streams, 0 to 1: 1 where what holds particles in order errs by more than the
 * pressures of the stream, for it takes some per cent of c0 times the velocities of neighbours; 0
 * where water is nearly at rest and that order counts. The scene says so where something keeps the
 * water streaming, whose currents at rest, 0.001 c0, are slower: of 0.002 c0 on it streams. Of
 * other motions, waves and what is left of them, the relative velocity does, from 0.002 to 0.012
 * c0: with less, a standing wave of 12 rows loses a tenth of its dissipation. */
static inline double scheme_streams(const struct sph *s)
{
    const double share = fmax((s->step.stray / s->c0 - 0.002) / 0.01, scheme_kept(s));
    return share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
}

/* P_min = max(0, -min P) over all particles of all ranks, Pa [2.105]; 0 if it is off. Collective
 * over s->run->comm. */
double scheme_background(const struct sph *s);

#endif
