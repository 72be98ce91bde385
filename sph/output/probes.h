/* probes.h - gauges and the forces on bodies: columns of series.csv.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PROBES_H
#define SPH_PROBES_H

#include "../sph.h"
#include "../walls/sph_walls.h"

/* Headings of the columns of this scene (static memory) into names; returns their number, at most
 * PROBE_COLUMNS. */
enum { PROBE_COLUMNS = 3 * PROBES_MAX + 6 * BODIES_MAX };
int probes_columns(const struct run *r, const char **names);
/* Writes the values of these columns; needs prim and slope of the present state. Collective. */
void probes_row(struct sph *s, double *values);
/* Force of the fluid on body k and its moment about the centre: the momentum that went there in the
 * last step (forces.h); before the first step by body_average. Collective. */
struct force probes_force(struct sph *s, int k);

#endif
