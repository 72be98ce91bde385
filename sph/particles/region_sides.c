/* region_sides.c - see region_sides.h. SPDX-License-Identifier: BSD-3-Clause */
#include "region_sides.h"

#include "../../common/scene/scene.h"

static const double inside = 3.0; /* dx: half a column's width of 2 dx, and one for the birth */

static const struct scene_wall *wall_of(const struct sph *s, int side)
{
    return scene_wall_of(&s->run->scene, (enum scene_side)(SIDE_X_MIN + side));
}

bool region_side_opens(const struct sph *s, int side)
{
    const struct scene_wall *w = wall_of(s, side);
    return !s->periodic[side / 2] && (s->open[side] || (w && w->kind >= WALL_INFLOW));
}

bool region_side_passes(const struct sph *s, int side)
{
    return region_side_opens(s, side) || (!s->periodic[side / 2] && !wall_of(s, side));
}

double region_clear(const struct sph *s, int a, double x, bool (*is)(const struct sph *, int))
{
    const double lo = s->lo[a], hi = s->hi[a], near = 1e-6 * s->dx;
    const double depth = fmin(inside * s->dx, 0.5 * (hi - lo));
    if (x < lo - near || x > hi + near)
        return x;
    if (x < lo + depth && is(s, 2 * a))
        return lo + depth;
    return x > hi - depth && is(s, 2 * a + 1) ? hi - depth : x;
}
