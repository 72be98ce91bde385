/* restart_eos.h - a run that goes on with another equation of state keeps its pressures.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

struct h5;

/* Density, speed of sound, gamma and the size of gravity are written. Where they differ from those
 * of a file that is read, as the default speed of sound does in a longer run whose flow grows, all
 * particles of all levels get the masses that give them the file's pressures in their volumes, as
 * if they had started with what holds now; pressures in proportion to density and gravity, so that
 * water at rest stays so. Velocities stay. What is compared with the start is scaled by the whole
 * mass. Without it all pressures would change with c0^2 at once. After all else has been read.
 * Collective. */
void restart_eos(struct sph *s, struct h5 *f);
