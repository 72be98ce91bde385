/* sph_unused.c - what keys need that this run has, and what no row can say: walls beyond the region
 * of the particles, words of a text. In a coupled job keys of the shared groups may be the
 * partner's. SPDX-License-Identifier: BSD-3-Clause */
#include "sph_unused.h"

#include "../../common/scene/scene.h"
#include "../refinement/sph_refinement.h"
#include "../sph_facts.h"
#include "../walls/sph_walls.h"

/* "none" leaves the open sides of a box, and inlets, without what they need: it is read as not
 * given. Inlets are what they are without sides, and sides without them are nothing. */
static bool outer_counts(const struct run *r, const struct sph_params *given,
                         const struct sph_params *used)
{
    switch (given->outer) {
    case OUTER_NONE:
        return !sph_params_zones(r, used) && !scene_has_openings(&r->scene);
    case OUTER_SIDES:
        return scene_has_openings(&r->scene);
    default:
        return sph_params_zones(r, used);
    }
}

/* What the keys of the scene need, and sph alone says. */
static unsigned long long find_shared(const struct run *r, const struct sph_params *used)
{
    const struct scene *c = &r->scene;
    const bool surface = used->surface == SURFACE_YES;
    double still[3];
    const bool level = scene_has_wave(c) || (scene_still_gravity(c, still) > 0.0 &&
                                             c->initial.field != FIELD_POISEUILLE);
    unsigned long long lacks = FACT(INFLOW);
    lacks |= surface ? FACT(FULL) : FACT(SURFACE);
    lacks |= level ? 0 : FACT(STILL);
    lacks |= sph_params_zones(r, used) ? 0 : FACT(ZONES);
    lacks |= used->outer == OUTER_SIDES ? 0 : FACT(OPENINGS);
    return scene_facts(c, r->params) & ~lacks;
}

/* What those of sph and apr need. */
static unsigned long long find_own(const struct run *r, const struct sph_params *given,
                                   const struct sph_params *used)
{
    const struct scene *c = &r->scene;
    const struct apr_params *apr = apr_params_of(r);
    const bool riemann = sph_params_is_riemann(used->scheme), planar = c->domain.dim == 2;
    const bool one_size = !apr || apr->method == APR_GUARDS, walls = sph_params_walls(c, used);
    const bool shifts = used->transport == TRANSPORT_TVS || used->transport == TRANSPORT_TVO;
    const bool surface = used->surface == SURFACE_YES, fluxes = walls && used->walls == WALLS_NFM;
    unsigned long long has = riemann ? FACT(RIEMANN) : FACT(ARTIFICIAL);
    has |= riemann && one_size ? FACT(ONE_SIZE) : 0;
    has |= surface && one_size && shifts ? FACT(SHIFT_ENDS) : 0;
    has |= shifts ? FACT(SHIFTED) : 0;
    has |= riemann && used->low_dissipation ? FACT(BOUNDED) : 0;
    has |= riemann && used->low_dissipation && used->dissipation > 0.0 ? FACT(FLOORED) : 0;
    has |= used->scheme == SCHEME_DELTA ? FACT(DIFFUSIVE) : 0;
    has |= c->fluid.nu > 0.0 ? FACT(VISCOUS) : 0;
    has |= walls ? FACT(WALLS) : 0;
    has |= fluxes ? FACT(FLUXES) : 0;
    has |= walls || used->noise > 0.0 ? FACT(PACKED) : 0;
    has |= surface ? 0 : FACT(NO_SURFACE);
    has |= planar ? FACT(PLANE) : 0;
    has |= sph_params_zones(r, used) ? FACT(ZONES) : 0;
    has |= outer_counts(r, given, used) ? FACT(OUTER) : 0;
    return has;
}

/* Whether a polyline comes near the region of the particles. */
static bool is_near(const struct scene *c, const struct sph_params *used,
                    const struct param_points *p)
{
    bool near = true;
    for (int a = 0; a < 2; a++) {
        double lo = INFINITY, hi = -INFINITY;
        for (int k = 0; k < p->n; k++) {
            lo = fmin(lo, p->x[k][a]);
            hi = fmax(hi, p->x[k][a]);
        }
        near = near && (c->domain.periodic[a] ||
                        (lo <= used->box[1][a] + used->dx && hi >= used->box[0][a] - used->dx));
    }
    return near;
}

/* A side that the box of the particles does not reach. */
static bool is_beyond(const struct run *r, const struct sph_params *used, int k)
{
    const struct scene_wall *w = r->scene.walls + k;
    return w->side != SIDE_NONE &&
           !sph_params_reaches(&r->scene.domain, used, w->side - SIDE_X_MIN);
}

/* Of coupled jobs, too: no partner has it. */
static void check_friction(const struct run *r, const struct sph_params *used, int k,
                           struct faults *f)
{
    params_unused(r->params, f, key_text("walls.[%d].friction", k), !is_beyond(r, used, k),
                  "sph.box does not reach this side, and fv has no bed friction");
}

/* Without a partner, who may have the wall. */
static void check_wall(const struct run *r, const struct sph_params *used, int k, struct faults *f)
{
    const struct scene_wall *w = r->scene.walls + k;
    params_unused(r->params, f, key_text("walls.[%d].side", k), !is_beyond(r, used, k),
                  "sph.box does not reach this side, and there is no group fv, which would");
    params_unused(r->params, f, key_text("walls.[%d].points", k),
                  w->side != SIDE_NONE || is_near(&r->scene, used, &w->points),
                  "it lies outside the region of the particles");
}

void sph_unused_check(const struct run *r, const struct param_group groups[2],
                      const struct sph_params *given, const struct sph_params *used,
                      struct faults *f)
{
    const unsigned long long own = find_own(r, given, used);
    const int n = apr_params_of(r) ? 2 : 1; /* nothing to refine: no keys of apr */
    params_check_use(r->params, groups, n, NULL, r, f);
    params_check_use(r->params, groups, n, &own, r, f);
    if (r->scene.domain.dim == 2)
        params_check_plane(r->params, groups, n, f);
    for (int k = 0; k < r->scene.nwalls; k++)
        check_friction(r, used, k, f);
    if (r->scene.has_fv)
        return;
    scene_check_facts(&r->scene, r->params, find_shared(r, used), f);
    for (int k = 0; k < r->scene.nwalls; k++)
        check_wall(r, used, k, f);
    scene_check_shown(&r->scene, r->params, "sph",
                      "velocity, pressure, density, vorticity, volume, zone, age, level, guard, id",
                      f);
}
