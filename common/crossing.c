/* crossing.c - see crossing.h. SPDX-License-Identifier: BSD-3-Clause */
#include "crossing.h"

#include <math.h>

#include "scene_fluid.h"

/* Axis along which gravity holds the water down, -1: none. */
static int upright(const struct scene *c)
{
    double g[3];
    int up = 0;
    if (scene_still_gravity(c, g) == 0.0)
        return -1;
    for (int a = 1; a < c->domain.dim; a++)
        up = fabs(g[a]) > fabs(g[up]) ? a : up;
    return up;
}

bool crossing_find(const struct run *r)
{
    const struct scene_domain *d = &r->scene.domain;
    double box[2][3];
    bool ends = false;
    if (!r->coupled || !r->scene.has_sph || !r->scene.has_fv || !scene_has_surface(&r->scene))
        return false;
    const int up = upright(&r->scene);
    if (up < 0 || (!params_peek_pair(r->params, r->comm, "sph.box", box) &&
                   !params_peek_pair(r->params, r->comm, "sph.free", box)))
        return false;
    for (int a = 0; a < d->dim; a++) {
        const double eps = 1e-9 * (d->max[a] - d->min[a]);
        if (a != up && box[1][a] > box[0][a])
            ends = ends || box[0][a] > d->min[a] + eps || box[1][a] < d->max[a] - eps;
    }
    return ends;
}
