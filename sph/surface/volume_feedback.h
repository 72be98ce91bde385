/* volume_feedback.h - volumes follow, slowly, the room that particles have.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_VOLUME_FEEDBACK_H
#define SPH_VOLUME_FEEDBACK_H

#include "surface.h"

/* Before the first pass of a step: whether volumes are to follow, and room for n locals. */
void volume_feedback_prepare(struct sph *s);
/* After surface_detect and the walls' measures: rates of the step from the kernel sums that the
 * first pass has left in s->surface->less. */
void volume_feedback_find(struct sph *s);
/* Adds them to the rates of a stage. */
void volume_feedback_add(struct sph *s);
/* At the start, after gradients: goes the whole way at once, with the masses, where walls are near.
 * What the first particles leave free between themselves and walls is so filled, and the level
 * stays where it is. Lists are to be made again; false: nothing follows. */
bool volume_feedback_fill(struct sph *s);

#endif
