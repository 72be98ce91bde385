/* wall_ends.h - lines that end in the fluid: their back is no wall, and what lies behind them is
 * acts through them. 2D. SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef SPH_WALL_ENDS_H
#define SPH_WALL_ENDS_H

#include "../../common/scene/scene.h"

struct wall_end {
    int wall;     /* in the scene's list */
    double at[2]; /* m: the free end */
    bool stands;  /* the other end stands on a wall; else water is there at the start */
};

/* The first of them, in water of particles dx, m, apart. */
bool wall_ends_open(const struct scene *c, double dx, struct wall_end *e);

#endif
