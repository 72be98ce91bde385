/* region.h - the part of a source's data that a coupler rank wants. Sources send nothing else, and
 * the region is sent anew only when targets leave it. For points it is cells of space around the
 * targets, for grids boxes of cells, one per asking rank. Part of libcpl.a: no MPI.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdint.h>

struct wire;
struct message;
struct pack;

/* A region; the arrays are owned, see region_free. {0} wants nothing. */
struct region {
    int dim; /* 2 or 3; 0: nothing is wanted */
    int all; /* every point, wherever it lies; no images */
    /* Points: a bit map over cells i <= (x - 0)/edge < i + 1; period 0: not periodic. */
    double edge, period[3]; /* m: of a cell; of the targets' space */
    int lo[3], n[3];        /* the map's first cell, and its numbers of cells */
    unsigned char *wanted;  /* [n[2]][n[1]][n[0]] */
    /* Grids: boxes lo <= i < hi in the unwrapped index space. */
    int nboxes;
    struct region_box {
        int asker, lo[3], hi[3];
    } * box;
};

/* Cells that hold any point within R, m, of the targets x[n][dim], and `slack' cells more on each
 * side, so that small motions of the targets stay inside. */
struct region region_around(int dim, double R, const double period[3], long n, const double *x,
                            int slack);
/* Cells first <= i < last that a patch needs to be evaluated in the box [lo, hi]: those of the box
 * and three more on each side, which cubic stencils and their averages want; where the grid is not
 * periodic only those that exist. An empty box (lo > hi) gives no cells. */
void region_cells(int dim, const double origin[3], const double spacing[3], const int cells[3],
                  const int periodic[3], const double lo[3], const double hi[3], int first[3],
                  int last[3]);
/* Whether a includes all of b (both of points, with the same R, or both of grids). */
bool region_holds(const struct region *a, const struct region *b);
/* Number of images of a point x (itself and its periodic ones) that lie in the region, with their
 * positions in image. If image is NULL, only whether there is any: 0 or 1. */
int region_images(const struct region *r, const double *x, double image[27][3]);
/* Appends the region to a message; region_take reads it back, owned by the caller. */
void region_pack(struct pack *p, const struct region *r);
struct region region_take(struct wire *w, struct message *m);
/* Frees the arrays and leaves a region that wants nothing. */
void region_free(struct region *r);
