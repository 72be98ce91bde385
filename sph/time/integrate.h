/* integrate.h - one step of all levels, and what a stage does.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_INTEGRATE_H
#define SPH_INTEGRATE_H

#include <stdbool.h>

struct diagnosis;
struct sph;

/* One step of at most dt_max; see program.step. */
double integrate_step(struct sph *s, double t_stop, struct diagnosis *d);
/* Neighbour list and halo of the present positions, then rates of y at s->t (what a stage does). */
void integrate_prepare(struct sph *s);
void integrate_rates(struct sph *s);
/* prim and slope of the present state, for output and errors; what is imposed from outside stays
 * out. */
void integrate_gradients(struct sph *s);
/* First time step, skin and extremes from the state at t = 0. */
void integrate_start(struct sph *s);

#endif
