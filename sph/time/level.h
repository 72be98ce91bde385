/* level.h - one level of particles (without refinement: all of them) within a step: list and
 * ghosts, rates of a stage, what follows from these, and who is returned or removed at its end.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_LEVEL_H
#define SPH_LEVEL_H

#include "../sph.h"

/* Migration, sort, ghosts, list of pairs, lists of walls, for the positions of y at s->t. */
void level_prepare(struct sph *s);
/* A stage: walls, what is imposed, lines; then, when guards have their fields, rates of y: both
 * passes and the walls. */
void level_begin_rates(struct sph *s);
void level_rates(struct sph *s);
/* All slopes, whatever the scheme needs; shared: they serve the next step's first stage as well,
 * which does the same and imposes nothing before. */
void level_gradients(struct sph *s, bool shared);
/* y after stage k of a step of dt. */
void level_update(struct sph *s, int k, double dt);
/* Puts back what has passed walls; removes what is too far behind, or beyond an end where nothing
 * holds it; returns the number of these. */
int level_clean(struct sph *s);
/* Largest step that signals and the skin allow, s; INFINITY: nothing flows. by: what bounds it. */
double level_dt(const struct sph *s, const char **by);

#endif
