/* wall_ends.h - lines that stand on another wall and end in the fluid: their back is no wall, and
 * the wall that goes on behind them is felt through them. 2D. SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef SPH_WALL_ENDS_H
#define SPH_WALL_ENDS_H

#include "../../common/scene.h"

struct wall_end {
    int wall;              /* in the scene's list */
    double at[2], foot[2]; /* m: the free end, and the other one */
};

/* The first of them; ends within near, m, of a wall meet it. */
bool wall_ends_open(const struct scene *c, double near, struct wall_end *e);

#endif
