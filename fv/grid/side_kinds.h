/* side_kinds.h - what is behind a side, of a block or of the uniform grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/scene/scene.h"

/* Kinds of sides (blocks.i_min and the like, or that of the wall of the scene there). WALL is a
 * no-slip wall, EXACT takes the velocity of the scene's exact solution; OVERLAP leaves the side to
 * the other blocks, JOINED says that it meets the face of one. */
enum mesh_side {
    MESH_NONE, /* of the uniform grid: periodic, or the exact velocity */
    MESH_OVERLAP = MESH_NONE,
    MESH_JOINED,
    MESH_PERIODIC,
    MESH_WALL,
    MESH_SLIP,
    MESH_INFLOW,
    MESH_OUTFLOW,
    MESH_EXACT,
    MESH_CARRIED, /* convective outflow; from `walls' alone */
    MESH_LAST = MESH_CARRIED
};

/* Whether nothing passes a side of this kind, with friction or without. */
static inline bool side_is_wall(enum mesh_side k) { return k == MESH_WALL || k == MESH_SLIP; }
/* Whether it ends the flow: no overlap, join or period. */
static inline bool side_is_end(enum mesh_side k)
{
    return k != MESH_OVERLAP && k != MESH_JOINED && k != MESH_PERIODIC;
}
/* Whether its flux is given, so that psi does not pass: all ends but those with a pressure. */
static inline bool side_gives_flux(enum mesh_side k) { return side_is_end(k) && k != MESH_OUTFLOW; }
/* Whether fluid passes it that does work on the flow, or the flow on it. */
static inline bool side_is_opening(enum mesh_side k)
{
    return side_is_end(k) && !side_is_wall(k) && k != MESH_EXACT;
}

/* The kind of side that a wall of the scene makes: convective outflow and given discharge have
 * velocities that change in time; an inflow with a given level has its pressure given, as an
 * outflow has. */
static inline enum mesh_side side_of_wall(const struct scene_wall *w)
{
    static const enum mesh_side kinds[] = {MESH_SLIP, MESH_WALL, MESH_INFLOW, MESH_OUTFLOW};
    if (w->carried || w->has_discharge) /* both have velocities that change */
        return MESH_CARRIED;
    if (w->kind > WALL_OUTFLOW) /* what this program has no side for is closed */
        return MESH_SLIP;
    return w->kind == WALL_INFLOW && w->has_level ? MESH_OUTFLOW : kinds[w->kind];
}
