/* body_water.h - what of the bodies stands below the level of still water, as points of a lattice:
 * they count as water where a partner finds the surface from what particles fill, since a body that
 * pierces the surface is a wall of the water and no part of its surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_WATER_H
#define SPH_BODY_WATER_H

#include "../sph.h"

struct body_water {
    int n;
    double *x;             /* [n][3] m; each stands for dx^dim */
    int64_t *id;           /* < 0, the same on any number of ranks */
    double searched[3][3]; /* m: corner of the region, of this rank's part the least and largest
                            * coordinates, as they were when the points were found */
};

/* Those of this rank's part of the free and the blended zone, where bodies are now. Bodies that
 * never move, in a region that stays, keep theirs. */
void body_water_find(const struct sph *s, struct body_water *b);

#endif
