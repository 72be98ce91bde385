/* basins.h - which waters of the first lattice are connected, and the level that each of its
 * columns has.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "lattice.h"

struct basins;
/* From the filled cells; the same on all ranks. l is borrowed. Needs s->walls. Owned by the caller
 * (FREE). */
struct basins *basins_create(const struct sph *s, const struct lattice *l);
/* Removes from the lattice enclosed pockets too small to flow, which walls cut off. */
void basins_clear(const struct basins *b, struct lattice *l);
/* Counts the rooms that meshes separate, pockets left out: *wet with fluid, *dry without. */
void basins_rooms(const struct basins *b, int *wet, int *dry);
/* Number of pockets, with their *cells in all and the position of one, m. */
int basins_pockets(const struct basins *b, int64_t *cells, double *where);
/* How far the water under roofs stands above its level at most, m: there it hangs by suction;
 * where: the place. 0: nowhere. */
double basins_suction(const struct basins *b, double *where);
/* Height against gravity where p = 0 for the water of this cell, m; NAN: it falls freely. */
double basins_level(const struct basins *b, int64_t cell);
