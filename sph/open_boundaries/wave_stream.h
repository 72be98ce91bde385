/* wave_stream.h - waves on a current, or with a transport of their own, as the water beyond the
 * open sides at both ends of their way (common/scene/scene_currents.h): behind a wave zone the
 * waves on the current, behind a beach the mean flow and the still level.
 * Velocity, pressure and level are all given; a small outflow (level_gap.h) keeps the particles'
 * level at that. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WAVE_STREAM_H
#define SPH_WAVE_STREAM_H

#include "zones.h"

/* Whether the case has such waves. */
bool wave_stream_wanted(const struct run *r, const struct sph_params *prm);
zones_eval wave_stream_eval; /* gradients by central differences */
/* Installs this outer solution in z, which frees it. */
void wave_stream_create(struct sph *s, struct zones *z);
/* Level of the water outside a side, m against gravity. */
double wave_stream_level(const struct sph *s, int side);

#endif
