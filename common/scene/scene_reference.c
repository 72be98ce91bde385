/* scene_reference.c - see scene_reference.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_reference.h"

#include <math.h>

double scene_reference_left(const struct scene *s, const struct scene_reference *r,
                            const struct scene_wall *w)
{
    const int side = w->side - SIDE_X_MIN;
    double x[3];
    for (int a = 0; a < 3; a++)
        x[a] = 0.5 * (s->domain.min[a] + s->domain.max[a]);
    x[side / 2] = side % 2 ? s->domain.max[side / 2] : s->domain.min[side / 2];
    return w->pressure - scene_reference_at(r, s->domain.dim, x);
}

struct scene_reference scene_reference(const struct scene *s)
{
    struct scene_reference r = {0};
    double least = INFINITY;
    if (scene_has_surface(s))
        return r;
    for (int a = 0; a < s->domain.dim; a++)
        r.slope[a] = s->domain.periodic[a] ? 0.0 : s->fluid.rho * s->fluid.gravity[a];
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].kind >= WALL_OUTFLOW)
            least = fmin(least, scene_reference_left(s, &r, s->walls + k));
    if (!isfinite(least))
        return (struct scene_reference){0};
    r.p = least;
    return r;
}
