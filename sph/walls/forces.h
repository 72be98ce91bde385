/* forces.h - momentum that the fluid gives to bodies and to the walls at rest: what the wall
 * model credits to them at each stage, and what particles that are returned leave there. Summed
 * with the weights of the stages, so that the balance of momentum closes to the last
 * digit. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_FORCES_H
#define SPH_FORCES_H

#include "walls.h"

struct h5;

/* Before the model's rates: nothing credited yet. */
void forces_clear(struct walls *w);
/* The fluid at x[dim] pushes a body (-1: the walls at rest) with f[dim], N (2D: N/m). */
void forces_add(const struct sph *s, int body, const double *x, const double *f);
/* The same once, with an impulse, N s (2D: N s/m). */
void forces_hit(const struct sph *s, int body, const double *x, const double *impulse);
/* What `from' has of the stage or the step under way goes to `to', the walls of another level. */
void forces_join_stage(struct walls *to, const struct walls *from);
void forces_join_step(struct walls *to, struct walls *from);
/* Adds to the moment on body k what its turning takes from the friction of Morris's term; see
 * forces.c. */
void forces_add_turning(const struct sph *s, int k, double moment[3]);
/* After a stage that counts for dt, s, of the step; at the end of a step of dt. The latter is
 * collective. */
void forces_stage(struct sph *s, double dt);
void forces_step(struct sph *s, double dt);
/* Mean over the last step of the force on body k and its moment about the body's centre (k =
 * BODIES_MAX: on the walls at rest, about the origin); false before the first step, and where the
 * model credits nothing. */
bool forces_of(const struct sph *s, int k, struct force *f);
/* Impulses of the restart file. Collective. */
void forces_save(const struct sph *s, struct h5 *f);
bool forces_load(struct sph *s, struct h5 *f);
/* force.* of the first body over the second half of the run and its error against the case's;
 * momentum.defect: what momentum, gravity and impulses leave over. Collective. */
void forces_summarise(const struct sph *s);

#endif
