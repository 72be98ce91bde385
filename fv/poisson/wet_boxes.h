/* wet_boxes.h - boxes of cells that hold all of this rank's water, so that the pressure solver has
 * no more air than lies beside it in a tile.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../fv.h"

/* The boxes; owned. */
struct wet_boxes {
    int n;
    int (*lo)[3], (*hi)[3]; /* first and last cells, of the whole grid */
    int64_t cells;
};

/* run = {first wet cell of a line of n cells along x, number of those up to the last one}; {0, 0}:
 * none. layer: of the surface, 0 where water is. */
void wet_boxes_run(const unsigned char *layer, int n, int run[2]);
/* Finds the boxes; without a surface, without water, or with a periodic axis they are all cells of
 * the rank. Returns whether they differ from before on some rank. Collective. */
bool wet_boxes_find(const struct fv *s, void *owner, struct wet_boxes *w);
