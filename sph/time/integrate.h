/* integrate.h - one step of all levels, and what a stage does. s is always the coarsest level; all
 * calls are collective over s->run->comm.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_INTEGRATE_H
#define SPH_INTEGRATE_H

#include <stdbool.h>

struct diagnosis;
struct sph;

/* One step of at most the stable size towards t_stop, s; returns its size. See `step' of struct
 * program. */
double integrate_step(struct sph *s, double t_stop, struct diagnosis *d);
/* integrate_prepare makes neighbour lists, ghosts and halo for the present positions, unless they
 * are ready. integrate_rates then computes the rates of y at s->t, as a stage does. */
void integrate_prepare(struct sph *s);
void integrate_rates(struct sph *s);
/* Computes prim and slope of the present state, for output and errors; zones impose nothing on
 * them. */
void integrate_gradients(struct sph *s);
/* Sets the first time step, the skin and s->step from the state at t = 0. */
void integrate_start(struct sph *s);

#endif
