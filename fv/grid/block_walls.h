/* block_walls.h - the closed sides of blocks as faces in space. Every rank knows all of them.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "mesh.h"

/* Walls within reach of one point, at most two across each axis, and its images beyond them. */
enum { WALLS_MOST = 6, IMAGES_MOST = 1 << WALLS_MOST };

struct block_walls;

/* Of all blocks where they are now; freed by FREE. m is borrowed. */
struct block_walls *block_walls_create(const struct mesh *m);
/* x[0] is a point; its images beyond walls nearer than R, m, are put behind it. Returns the number
 * of points, itself included, at most IMAGES_MOST. */
int block_walls_images(const struct block_walls *w, double R, double (*x)[3]);

/* The face nearest to a point. */
struct nearest_wall {
    int block, cell[3]; /* that it is of */
    double height;      /* m: of the place over it, < 0: behind */
    double radius;      /* m: of its farthest vertex from its middle */
};
/* Finds the nearest face to x; false: there is no wall. */
bool block_walls_nearest(const struct block_walls *w, const double *x, struct nearest_wall *to);

/* One face of a closed side. */
struct wall_face {
    int block, cell[3]; /* that it is of */
    double x[3];        /* m: its middle */
    double radius;      /* m: of its farthest vertex from that */
};
/* The i-th of all faces; false: there are fewer. */
bool block_walls_face(const struct block_walls *w, int64_t i, struct wall_face *to);
