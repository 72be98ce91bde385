/* sph_unused.c - every key of the case that this run would pass over, with the reason: a table of
 * key, what it needs, and why. A key that always counts has no row. In a coupled job those of the
 * shared groups may be the partner's. SPDX-License-Identifier: BSD-3-Clause */
#include "sph_unused.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../common/scene/exact.h"
#include "../../common/scene/scene_fluid.h"
#include "../refinement/apr_params.h"
#include "../walls/walls.h"

/* What keys need. */
enum {
    RIEMANN,        /* a Riemann scheme */
    ONE_SIZE,       /* and pairs of particles of one size */
    SHIFT_ENDS,     /* a law of shifting that meets a free surface */
    BOUNDED,        /* low_dissipation of one */
    ARTIFICIAL,     /* scheme delta or standard */
    DIFFUSIVE,      /* scheme delta */
    VISCOUS,        /* fluid.nu > 0 */
    WALLS,          /* walls or bodies that particles meet */
    FLUXES,         /* normal flux walls */
    CLIPPED,        /* in 3D, and their integrals by clipped squares */
    PACKED,         /* walls, bodies, or noise: the first places are rearranged */
    NO_SURFACE,     /* no free surface */
    PLANE,          /* two dimensions */
    ZONES,          /* open sides */
    HYDROSTATIC,    /* a level: a wave, or weight that no field has of its own */
    OUTER,          /* open sides that the case leaves to it */
    COUPLED,        /* a partner */
    OPENINGS_COUNT, /* inlets and outlets are what feeds the open sides */
    NEEDS
};

static bool any_opening(const struct scene *c)
{
    bool any = false;
    for (int k = 0; k < c->nwalls; k++)
        any = any || scene_wall_opens(c->walls + k);
    return any;
}

/* "none" leaves the open sides of a box, and inlets, without what they need: it is read as not
 * given. Inlets are what they are without sides, and sides without them are nothing. */
static bool outer_counts(const struct run *r, const struct sph_params *given,
                         const struct sph_params *used)
{
    switch (given->outer) {
    case OUTER_NONE:
        return !sph_params_zones(r, used) && !any_opening(&r->scene);
    case OUTER_SIDES:
        return any_opening(&r->scene);
    default:
        return sph_params_zones(r, used);
    }
}

static void find_needs(const struct run *r, const struct sph_params *given,
                       const struct sph_params *used, bool has[NEEDS])
{
    const struct scene *c = &r->scene;
    const int field = c->initial.field;
    const struct apr_params *apr = apr_params_of(r);
    double still[3];
    has[RIEMANN] = used->scheme == SCHEME_RIEMANN_ALE || used->scheme == SCHEME_RIEMANN;
    has[ONE_SIZE] = has[RIEMANN] && (!apr || apr->method == APR_GUARDS);
    has[SHIFT_ENDS] = used->surface == SURFACE_YES && (!apr || apr->method == APR_GUARDS) &&
                      (used->transport == TRANSPORT_TVS || used->transport == TRANSPORT_TVO);
    has[BOUNDED] = has[RIEMANN] && used->low_dissipation;
    has[ARTIFICIAL] = !has[RIEMANN];
    has[DIFFUSIVE] = used->scheme == SCHEME_DELTA;
    has[VISCOUS] = c->fluid.nu > 0.0;
    has[WALLS] = sph_params_walls(c, used);
    has[FLUXES] = has[WALLS] && used->walls == WALLS_NFM;
    has[CLIPPED] = has[FLUXES] && c->domain.dim == 3 && used->wall_integrals == INTEGRALS_CLIPPED;
    has[PACKED] = has[WALLS] || used->noise > 0.0;
    has[NO_SURFACE] = used->surface != SURFACE_YES;
    has[PLANE] = c->domain.dim == 2;
    has[ZONES] = sph_params_zones(r, used);
    has[HYDROSTATIC] =
        scene_has_wave(c) || (scene_still_gravity(c, still) > 0.0 && field != FIELD_POISEUILLE);
    has[OUTER] = outer_counts(r, given, used);
    has[COUPLED] = r->scene.has_fv;
    has[OPENINGS_COUNT] = used->outer == OUTER_SIDES;
}

static const struct {
    const char *key;
    int need;
    const char *why;
} rows[] = {
    {"sph.limiter", RIEMANN, "schemes delta and standard reconstruct nothing between particles"},
    {"sph.riemann", ONE_SIZE,
     "only the Riemann schemes solve Riemann problems, and sets of several sizes (apr.method) the "
     "linear ones alone"},
    {"sph.surface_shift", SHIFT_ENDS,
     "no law of shifting (sph.transport) meets a free surface, or sets of several sizes "
     "(apr.method) have their own"},
    {"sph.low_dissipation", RIEMANN, "schemes delta and standard solve no Riemann problem"},
    {"sph.dissipation", BOUNDED,
     "it is the floor of low_dissipation, which is off or has no Riemann "
     "scheme"},
    {"sph.damper", RIEMANN, "schemes delta and standard have no pair pressure that it could damp"},
    {"sph.alpha", ARTIFICIAL,
     "the Riemann schemes have no artificial viscosity: see sph.dissipation"},
    {"sph.delta", DIFFUSIVE, "only scheme delta diffuses density"},
    {"sph.viscosity", VISCOUS, "fluid.nu is 0: nothing viscous is computed"},
    {"sph.cfl_viscous", VISCOUS, "fluid.nu is 0: nothing viscous limits dt"},
    {"sph.background", NO_SURFACE, "the pressure of a free surface is 0"},
    {"sph.walls", WALLS, "the particles have no wall and no body"},
    {"sph.wall_integrals", FLUXES, "the particles have no normal flux walls (sph.walls)"},
    {"sph.wall_squares", CLIPPED, "sph.wall_integrals is not clipped"},
    {"sph.packing", PACKED, "without walls, bodies and noise the lattice is uniform already"},
    {"sph.extrema", PLANE, "centre lines are read in two dimensions only"},
    {"sph.births", ZONES, "no side of the particles' region is open"},
    {"sph.outer", OUTER,
     "no side of the particles' region is open, or inlets and boxes say what is outside; sides "
     "needs an inlet or an outlet among the walls"},
};

/* Of the shared groups: counted by a partner, if there is one. */
static const struct {
    const char *key;
    int need;
    const char *why;
} shared[] = {
    {"initial.level", HYDROSTATIC,
     "nothing has a level: no weight outside periodic axes, or a field "
     "with a pressure of its own"},
    {"coupling.steps", COUPLED, "the case has one program: group coupling is for two"},
    {"coupling.transition", ZONES, "no side of the particles' region is open"},
    {"coupling.buffer", ZONES, "no side of the particles' region is open"},
    {"coupling.overlap", COUPLED, "the case has one program: no cells lie under the particles"},
    {"coupling.memory", COUPLED, "the case has one program: no pressure is handed over"},
    {"coupling.keep_mass", COUPLED, "the case has one program: there are no coupling steps"},
    {"coupling.mapping", COUPLED, "the case has one program: there are no imposed cells"},
    {"coupling.interpolation", COUPLED, "the case has one program: there are no cells"},
    {"coupling.in_time", COUPLED, "the case has one program: there are no cells"},
    {"coupling.deadline", COUPLED, "the case has one program: there is no other one to find"},
};

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
    char key[64];
    snprintf(key, sizeof key, "walls.[%d].friction", k);
    params_unused(r->params, f, key, !is_beyond(r, used, k),
                  "sph.box does not reach this side, and fv has no bed friction");
}

static void check_wall(const struct run *r, const struct sph_params *used, const bool *has, int k,
                       struct faults *f)
{
    const struct scene_wall *w = r->scene.walls + k;
    const bool beyond = is_beyond(r, used, k), surface = used->surface == SURFACE_YES;
    char key[64];
    snprintf(key, sizeof key, "walls.[%d].side", k);
    params_unused(r->params, f, key, !beyond, "sph.box does not reach this side");
    snprintf(key, sizeof key, "walls.[%d].points", k);
    params_unused(r->params, f, key, w->side != SIDE_NONE || is_near(&r->scene, used, &w->points),
                  "it lies outside the region of the particles");
    snprintf(key, sizeof key, "walls.[%d].kind", k);
    params_unused(r->params, f, key, w->kind != WALL_NO_SLIP || has[VISCOUS],
                  "without viscosity (fluid.nu) a wall exerts no friction: give slip");
    params_unused(r->params, f, key, !scene_wall_opens(w) || has[OPENINGS_COUNT],
                  "the flow around the particles (sph.outer) is known otherwise");
    snprintf(key, sizeof key, "walls.[%d].carried", k);
    params_unused(r->params, f, key, false, "sph has no convective outflow");
    static const char *const beach[] = {"beach", "beach_period"};
    for (int i = 0; i < 2; i++) {
        snprintf(key, sizeof key, "walls.[%d].%s", k, beach[i]);
        params_unused(r->params, f, key, surface, "there is no free surface, so no waves");
    }
    static const char *const level[] = {"level", "level_file"}, *const discharge[] = {
                                                                    "discharge", "discharge_file"};
    for (int i = 0; i < 2; i++) {
        snprintf(key, sizeof key, "walls.[%d].%s", k, level[i]);
        params_unused(r->params, f, key, surface, "there is no free surface");
        snprintf(key, sizeof key, "walls.[%d].%s", k, discharge[i]);
        params_unused(r->params, f, key, surface,
                      "without a free surface the area of an opening is known: give the velocity");
    }
    snprintf(key, sizeof key, "walls.[%d].pressure", k);
    params_unused(r->params, f, key, !surface,
                  "under a free surface the level says it (walls.level)");
    snprintf(key, sizeof key, "walls.[%d].profile", k);
    params_unused(r->params, f, key, !surface,
                  "under a free surface an inflow is uniform over its water");
}

static void check_body(const struct run *r, const bool *has, int k, struct faults *f)
{
    char key[64];
    snprintf(key, sizeof key, "bodies.[%d].kind", k);
    params_unused(r->params, f, key, r->scene.bodies[k].kind != WALL_NO_SLIP || has[VISCOUS],
                  "without viscosity (fluid.nu) a body exerts no friction: give slip");
}

/* Words of output.fields that no particle has. */
static void check_fields(const struct run *r, struct faults *f)
{
    static const char known[] =
        " velocity pressure density vorticity volume zone age level guard id ";
    const char *at = r->scene.output.fields;
    while (*(at += strspn(at, " ,"))) {
        char word[PARAM_TEXT_SIZE + 2];
        const int n = (int)strcspn(at, " ,");
        snprintf(word, sizeof word, " %.*s ", n, at);
        if (!strstr(known, word))
            params_fault(r->params, f, "output.fields", "no field%sof particles; there are:%s",
                         word, known);
        at += n;
    }
}

void sph_unused_check(const struct run *r, const struct sph_params *given,
                      const struct sph_params *used, struct faults *f)
{
    bool has[NEEDS];
    find_needs(r, given, used, has);
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++)
        params_unused(r->params, f, rows[k].key, has[rows[k].need], rows[k].why);
    for (int k = 0; k < r->scene.nwalls; k++)
        check_friction(r, used, k, f);
    if (r->scene.has_fv)
        return;
    for (size_t k = 0; k < sizeof shared / sizeof shared[0]; k++)
        params_unused(r->params, f, shared[k].key, has[shared[k].need], shared[k].why);
    for (int k = 0; k < r->scene.nwalls; k++)
        check_wall(r, used, has, k, f);
    for (int k = 0; k < r->scene.nbodies; k++)
        check_body(r, has, k, f);
    check_fields(r, f);
}
