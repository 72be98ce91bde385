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
/* Force of the fluid on body k and its moment about the centre: [N/m], [N/m], [N]. The pressure at
 * a point of the surface is the kernel average of what the particles lay on it [4.14]: the wall
 * terms of the particles add up to 1.39 times a constant pressure. Collective. */
void probes_force(struct sph *s, int k, double force[3]);
/* Mean force on the first body over the second half of the run, its fluctuation and its error
 * against the case's, into the summary. */
void probes_summarise(const struct sph *s);

#endif
