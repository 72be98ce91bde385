/* probes.h - gauges and the forces on bodies: columns of series.csv.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PROBES_H
#define SPH_PROBES_H

#include "sph.h"

/* Names of the columns of this scene (static storage); returns their number. */
enum { PROBE_COLUMNS = PROBES_MAX + 3 * BODIES_MAX };
int probes_columns(const struct run *r, const char **names);
/* Their values; needs prim and slope of the present state. Collective. */
void probes_row(struct sph *s, double *values);
/* Force of the fluid on body k and its moment about the centre: [N/m], [N/m], [N]: the momentum
 * that went there in the last step (forces.h); before the first one probes_average. Collective. */
void probes_force(struct sph *s, int k, double force[3]);
/* The same from the pressure on the body's surface, at each point the kernel average of what the
 * particles around would have there at rest: the second opinion. (What the walls' terms of the
 * particles add up to is 1.39 times a constant pressure.) Collective. */
void probes_average(struct sph *s, int k, double force[3]);

#endif
