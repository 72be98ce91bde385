/* block_walls.h - the closed sides of blocks as faces in space.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_BLOCK_WALLS_H
#define FV_BLOCK_WALLS_H

#include "mesh.h"

/* Walls within reach of one place, at most two across each axis, and its images beyond them. */
enum { WALLS_MOST = 6, IMAGES_MOST = 1 << WALLS_MOST };

struct block_walls;

/* Of all blocks where they stand now. */
struct block_walls *block_walls_create(const struct mesh *m);
void block_walls_free(struct block_walls **w);
/* x[0] is a place; its images beyond walls that are less than R m away go behind it: their number,
 * with itself, at most IMAGES_MOST. */
int block_walls_images(const struct block_walls *w, double R, double (*x)[3]);

/* The face nearest to a place. */
struct nearest_wall {
    int block, cell[3]; /* that it is of */
    double height;      /* m: of the place over it, < 0: behind */
    double radius;      /* m: of its farthest vertex from its middle */
};
/* false: there is no wall. */
bool block_walls_nearest(const struct block_walls *w, const double *x, struct nearest_wall *to);

struct wall_face {
    int block, cell[3]; /* that it is of */
    double x[3];        /* m: its middle */
    double radius;      /* m: of its farthest vertex from that */
};
/* The i-th of all faces; false: there are fewer. */
bool block_walls_face(const struct block_walls *w, int64_t i, struct wall_face *to);

#endif
