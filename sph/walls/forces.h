/* forces.h - momentum that the fluid gives to bodies and to the walls at rest: what the wall model
 * reports at each stage, and what particles that are put back leave there. Sums use the weights of
 * the stages, so that the balance of momentum closes to the last digit.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_FORCES_H
#define SPH_FORCES_H

#include "walls.h"

struct h5;

/* Before the wall model's rates: zeroes the forces of the stage. */
void forces_clear(struct walls *w);
/* Adds the force f[dim], N (2D: N/m), that the fluid at x[dim] exerts on a body (-1: the walls at
 * rest), and its moment. */
void forces_add(const struct sph *s, int body, const double *x, const double *f);
/* Adds a force, N (2D: N/m), on the walls at rest, and its moment about the origin. */
void forces_add_at_rest(const struct sph *s, const double force[3], const double moment[3]);
/* Adds an impulse, N s (2D: N s/m), at x in the same way. */
void forces_hit(const struct sph *s, int body, const double *x, const double *impulse);
/* Adds the forces of the stage, or the impulses of the step, of `from', the walls of another level,
 * to `to'. */
void forces_join_stage(struct walls *to, const struct walls *from);
void forces_join_step(struct walls *to, struct walls *from);
/* Adds to the moment on body k what its rotation takes from the friction of Morris's term; see
 * forces.c. */
void forces_add_turning(const struct sph *s, int k, double moment[3]);
/* After a stage that counts for dt, s, of the step: adds to the step's impulses. forces_step, at
 * the end of a step of dt, sums them over the ranks and is collective. */
void forces_stage(struct sph *s, double dt);
void forces_step(struct sph *s, double dt);
/* Sets *f to the mean over the last step of the force on body k and its moment about the body's
 * centre (k = BODIES_MAX: on the walls at rest, about the origin). false before the first step, and
 * where the model reports nothing. */
bool forces_of(const struct sph *s, int k, struct force *f);
/* Impulses in the restart file. Collective; forces_load returns false if they do not fit. */
void forces_save(const struct sph *s, struct h5 *f);
bool forces_load(struct sph *s, struct h5 *f);
/* Writes force.* of the first body over the second half of the run with its error against the
 * case's value, and momentum.defect, the momentum that gravity and impulses do not explain.
 * Collective. */
void forces_summarise(const struct sph *s);

#endif
