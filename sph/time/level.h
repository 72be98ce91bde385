/* level.h - one level of particles (without refinement: all of them) within a step: list and
 * ghosts, rates of a stage, gradients, and which particles are put back or removed at its end.
 * Collective over s->run->comm but for level_update, level_clean and level_dt.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_LEVEL_H
#define SPH_LEVEL_H

#include "../sph.h"

/* Migration, sort, ghosts, list of pairs and lists of walls, for the positions of y at s->t. */
void level_prepare(struct sph *s);
/* A stage in two parts. level_begin_rates moves walls, imposes what zones impose, and packs the
 * records. When the guards have their fields, level_rates runs both passes, walls and body forces
 * into p.rate. */
void level_begin_rates(struct sph *s);
void level_rates(struct sph *s);
/* Computes all slopes, whatever the scheme needs of them. shared: they are what the next step's
 * first stage would compute, and it takes them as they are; not so where that stage imposes values
 * first. */
void level_gradients(struct sph *s, bool shared);
/* Advances y after stage k of a step of dt, s, by the coefficients of s->stages. */
void level_update(struct sph *s, int k, double dt);
/* Puts back particles that have passed walls; removes those too far behind one, or beyond an end of
 * the region where nothing holds them, and returns the number of the latter on this rank. */
int level_clean(struct sph *s);
/* Largest step that signals and the skin allow, s; INFINITY: nothing flows. *by is what bounds
 * it. */
double level_dt(const struct sph *s, const char **by);

#endif
