/* wall_ends.h - finds lines that end in the fluid: such a line has no wall on its back, and fluid
 * behind it interacts through it. 2D.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_ENDS_H
#define SPH_WALL_ENDS_H

#include "../../common/scene/scene.h"

/* A free end of a line. */
struct wall_end {
    int wall;     /* in the scene's list */
    double at[2]; /* m: the free end */
    bool stands;  /* the other end stands on a wall; else water is there at the start */
};

/* Sets *e to the first of them in water with particle spacing dx, m; false: there is none. */
bool wall_ends_open(const struct scene *c, double dx, struct wall_end *e);

#endif
