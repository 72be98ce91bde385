/* basins.h - which waters of the first lattice belong together, and the level that each of its
 * columns stands under. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BASINS_H
#define SPH_BASINS_H

#include "lattice.h"

struct basins;
/* Of the filled cells; the same on all ranks. l is borrowed. Needs s->walls. */
struct basins *basins_create(const struct sph *s, const struct lattice *l);
void basins_free(struct basins **b);
/* Takes from the lattice the pockets that walls cut off, too small to flow. */
void basins_clear(const struct basins *b, struct lattice *l);
/* Rooms that meshes part from each other, pockets left out: those with fluid and those without. */
void basins_rooms(const struct basins *b, int *wet, int *dry);
int basins_pockets(const struct basins *b, int64_t *cells, double *where); /* one place, m */
/* Height against gravity where p = 0 for the water of this cell, m; NAN: it falls freely. */
double basins_level(const struct basins *b, int64_t cell);

#endif
