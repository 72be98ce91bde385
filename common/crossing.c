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

/* sph.box, or else sph.free; false: neither is given. Collective. */
static bool peek_box(const struct run *r, double box[2][3])
{
    return params_peek_pair(r->params, r->comm, "sph.box", box) ||
           params_peek_pair(r->params, r->comm, "sph.free", box);
}

bool crossing_find(const struct run *r)
{
    const struct scene_domain *d = &r->scene.domain;
    double box[2][3];
    bool ends = false;
    if (!r->coupled || !r->scene.has_sph || !r->scene.has_fv || !scene_has_surface(&r->scene))
        return false;
    const int up = upright(&r->scene);
    if (up < 0 || !peek_box(r, box))
        return false;
    const bool falls = r->scene.fluid.gravity[up] < 0.0; /* towards the lower side */
    for (int a = 0; a < d->dim; a++) {
        const double eps = 1e-9 * (d->max[a] - d->min[a]);
        const bool low = box[0][a] > d->min[a] + eps, high = box[1][a] < d->max[a] - eps;
        if (box[1][a] > box[0][a])
            ends = ends || (a != up ? low || high : falls ? high : low);
    }
    return ends;
}

void crossing_deal(struct run *r)
{
    const struct scene *c = &r->scene;
    const int up = upright(c);
    double box[2][3];
    (void)peek_box(r, box); /* that of crossing_find */
    for (int k = 0; k < c->nprobes; k++) {
        const struct scene_probe *g = c->probes + k;
        r->gauge_inside[k] = true;
        for (int a = 0; a < c->domain.dim; a++)
            if (box[1][a] > box[0][a] && (a != up || g->kind == PROBE_PRESSURE))
                r->gauge_inside[k] =
                    r->gauge_inside[k] && g->at[a] >= box[0][a] && g->at[a] <= box[1][a];
    }
}

double crossing_time(const struct scene *c)
{
    double g[3];
    const double size = scene_still_gravity(c, g);
    const int up = upright(c);
    return up < 0 ? INFINITY : sqrt(crossing_depth(c, up) / size);
}

double crossing_depth(const struct scene *c, int a)
{
    const double floor = c->domain.min[a];
    if (c->initial.level < LEVEL_TOP)
        return c->initial.level - floor;
    double top = c->nshapes > 0 ? floor : c->domain.max[a];
    for (int k = 0; k < c->nshapes; k++) {
        const struct scene_shape *h = c->shapes + k;
        double high = h->form == SHAPE_BOX    ? h->box[1][a]
                      : h->form == SHAPE_DISC ? h->centre[a] + h->radius
                                              : h->level;
        for (int i = 0; i < h->points.n && h->form == SHAPE_POLYGON && a < 2; i++)
            high = i == 0 ? h->points.x[0][a] : fmax(high, h->points.x[i][a]);
        top = h->hole ? top : fmax(top, high);
    }
    return fmin(top, c->domain.max[a]) - floor;
}
