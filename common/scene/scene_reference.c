/* scene_reference.c - see scene_reference.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_reference.h"

#include "scene_fluid.h"

/* Middle of an opening. */
static void middle_of(const struct scene *s, const struct scene_wall *w, double x[3])
{
    const int side = w->side - SIDE_X_MIN;
    for (int a = 0; a < 3; a++)
        x[a] = 0.5 * (s->domain.min[a] + s->domain.max[a]);
    x[side / 2] = side % 2 ? s->domain.max[side / 2] : s->domain.min[side / 2];
}

/* Pressure at the middle of the openings under the level, Pa; 0 where they are at several heights,
 * between which the fluid falls. */
static double beneath(const struct scene *s)
{
    double x[3], still[3], low, high, least = INFINITY, most = -INFINITY;
    scene_heights(s, &low, &high);
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].kind >= WALL_OUTFLOW) {
            middle_of(s, s->walls + k, x);
            least = fmin(least, scene_height(s, x));
            most = fmax(most, scene_height(s, x));
        }
    if (!(most - least <= 1e-9 * (high - low)))
        return 0.0;
    const double level = s->initial.level < LEVEL_TOP ? s->initial.level : high;
    return s->fluid.rho * scene_still_gravity(s, still) * (level - most);
}

double scene_reference_left(const struct scene *s, const struct scene_reference *r,
                            const struct scene_wall *w)
{
    double x[3];
    middle_of(s, w, x);
    return w->pressure + r->beneath - scene_reference_at(r, s->domain.dim, x);
}

/* Without a surface the least of the outlets' pressures, and the slope of the weight across closed
 * sides, are left out of the pressures that are computed; without outlets nothing is. */
struct scene_reference scene_reference(const struct scene *s)
{
    struct scene_reference r = {0};
    double least = INFINITY;
    if (scene_has_surface(s))
        return r;
    for (int a = 0; a < s->domain.dim; a++)
        r.slope[a] = s->domain.periodic[a] ? 0.0 : s->fluid.rho * s->fluid.gravity[a];
    r.beneath = beneath(s);
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].kind >= WALL_OUTFLOW)
            least = fmin(least, scene_reference_left(s, &r, s->walls + k));
    if (!isfinite(least))
        return (struct scene_reference){0};
    r.p = least;
    return r;
}
