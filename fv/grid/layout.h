/* layout.h - how the ranks that wrote a restart file shared its grid, so that any number of ranks
 * can read it: boxes of cells with their ghosts, each a run of rows in the file's datasets.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_LAYOUT_H
#define FV_LAYOUT_H

#include <stdbool.h>
#include <stdint.h>

struct h5;
struct block;

/* A rank's cells lo .. lo + n - 1 of a grid, and g layers of ghosts around them, x fastest. */
struct layout_box {
    int grid; /* which, where a file is of several */
    int lo[3], n[3], g[3];
    int64_t base; /* of its first row, counted from the rank's own */
};

struct layout {
    int nboxes, writers;
    struct layout_box *of; /* [nboxes] of all writers */
    int *writer;           /* [nboxes] */
};

struct layout_box layout_block(const struct block *b);
/* Leaves the boxes of all ranks in the file under this name. */
void layout_save(struct h5 *f, const char *name, int n, const struct layout_box *of);
/* NULL: there are none. */
struct layout *layout_load(struct h5 *f, const char *name);
void layout_free(struct layout **l);
/* Whether as many ranks wrote the file as now read it. */
bool layout_same_ranks(const struct h5 *f, int size);
/* Says which cells the file is of where they are not these. */
bool layout_fits(const struct layout *l, int grid, const int cells[3]);
/* Cells of a grid by its boxes. */
void layout_cells(const struct layout *l, int grid, int cells[3]);
/* Fills this rank's box, ghosts and all, from a dataset of ncomp components: what lies in the grid
 * from the box that owns it; ghosts beyond its end the same along axes that wrap, else from the box
 * that owns the cell they stand beside. Collective. to[0]: corner of mine. */
bool layout_read(const struct layout *l, struct h5 *f, const char *name, int ncomp,
                 const struct layout_box *mine, const bool *wraps, double *to);
#endif
