/* forces.h - momentum that the fluid gives to bodies and to the walls at rest, in 2D: what the wall
 * model credits to them at each stage, and what particles that are put back leave there. Summed
 * with the weights of the Runge-Kutta stages, so that the balance of momentum closes to the last
 * digit. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_FORCES_H
#define SPH_FORCES_H

#include "walls.h"

struct h5;

/* Before the model's rates: nothing credited yet. */
void forces_clear(struct walls *w);
/* The fluid at x pushes a body (-1: the walls at rest) with f, N/m. */
void forces_add(struct walls *w, int body, const double *x, const double f[2]);
/* The same once, with an impulse, N s/m. */
void forces_hit(struct walls *w, int body, const double *x, const double impulse[2]);
/* After stage k = 0 .. 3 of a step of dt; at the end of the step. The latter is collective. */
void forces_stage(struct sph *s, int k, double dt);
void forces_step(struct sph *s, double dt);
/* Mean over the last step of the force on body k and its moment about the body's centre: [N/m],
 * [N/m], [N]; false before the first step, and where the model credits nothing. */
bool forces_of(const struct sph *s, int k, double force[3]);
/* Impulses of the restart file. Collective. */
void forces_save(const struct sph *s, struct h5 *f);
bool forces_load(struct sph *s, struct h5 *f);
/* force.* of the first body over the second half of the run and its error against the case's;
 * momentum.defect: what momentum, gravity and impulses leave over. Collective. */
void forces_summarise(const struct sph *s);

#endif
