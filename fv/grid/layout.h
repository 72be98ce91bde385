/* layout.h - how the ranks that wrote a restart file divided its grid, so that any number of ranks
 * can read it: boxes of cells with their ghosts, each a range of records in the file's datasets.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdint.h>

struct h5;
struct block;

/* A rank's cells lo .. lo + n - 1 of a grid, with g layers of ghosts around them, x fastest. */
struct layout_box {
    int grid; /* which, where a file is of several */
    int lo[3], n[3], g[3];
    int64_t base; /* of its first record, counted from the rank's own first */
};

/* The boxes of all writers; owned. */
struct layout {
    int nboxes;
    struct layout_box *of; /* [nboxes] of all writers */
    int *writer;           /* [nboxes] */
};

/* The box of this rank's part of a Cartesian grid. */
struct layout_box layout_block(const struct block *b);
/* Writes the n boxes of each rank to the file as dataset `name'. Collective. */
void layout_save(struct h5 *f, const char *name, int n, const struct layout_box *of);
/* Reads them; NULL: the file has none. Owned by the caller (FREE). Collective. */
struct layout *layout_load(struct h5 *f, const char *name);
/* Whether as many ranks wrote the file as now read it. */
bool layout_same_ranks(const struct h5 *f, int size);
/* Whether the file is of a grid of these cells; if not, logs of which. */
bool layout_fits(const struct layout *l, int grid, const int cells[3]);
/* Fills this rank's box, ghosts included, from a dataset of ncomp components: what lies in the grid
 * from the box that owns it; ghosts beyond its end likewise along axes that wrap, else from the box
 * that owns the cell beside them. to[0] is the corner of `mine'. false: the dataset does not fit.
 * Collective. */
bool layout_read(const struct layout *l, struct h5 *f, const char *name, int ncomp,
                 const struct layout_box *mine, const bool *wraps, double *to);
