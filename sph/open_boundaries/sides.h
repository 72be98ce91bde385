/* sides.h - inlets and outlets on sides of the domain: what the zones of zones.h impose when only
 * one half of the flow outside is known. Inflow: velocity given, pressure of the flow inside.
 * Outflow: pressure given at the domain's end, velocity of the flow inside. Absorbing: both from
 * the characteristics of the flow inside and of a far state (u, p of the case), so that sound
 * leaves.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SIDES_H
#define SPH_SIDES_H

#include "zones.h"

/* Installs this outer solution in z, which frees it. */
void sides_create(struct sph *s, struct zones *z);
/* Level of the water outside a side under a free surface, m against gravity; NAN: there is none. */
double sides_level(const struct sph *s, int side);
/* backflow.SIDE of the summary: what runs back at an outlet beside what leaves, over all that flows
 * through it, mean over the second half of the run; a warning where that is much. */
void sides_summarise(const struct sph *s);
/* Restart files, written or read; false: the file has none that fit. */
bool sides_restart(struct sph *s, struct h5 *f);

#endif
