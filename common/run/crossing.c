/* crossing.c - see crossing.h. Called by run.c once the scene is checked: crossing_find and
 * crossing_deal in that order, before the programs themselves look at the case. Boxes of groups of
 * particles, also those of other programs of the job, are read from the case itself
 * (params_peek_pair), and so all agree without a message.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "crossing.h"

#include "../scene/scene.h"

/* Either key; with sph.free the zones around it are not in it. */
bool crossing_box(const struct run *r, const char *group, double box[2][3])
{
    static const char *const keys[] = {"box", "free"};
    for (int i = 0; i < 2; i++) {
        if (params_peek_pair(r->params, r->comm, key_text(":%s.%s", group, keys[i]), box))
            return true;
    }
    return false;
}

/* Boxes of the groups sph, sph_NAME; those of SPH's program `only' alone, NULL: all. Returns how
 * many. Collective. */
static int peek_boxes(const struct run *r, const char *only, double box[PARAM_PROGRAMS_MAX][2][3])
{
    char names[PARAM_PROGRAMS_MAX][64];
    const int n = params_programs(r->params, "sph", names);
    int found = 0;
    for (int k = 0; k < n; k++)
        if (!only || strcmp(only, names[k]) == 0)
            found += crossing_box(r, names[k], box[found]);
    return found;
}

/* Whether a box ends in the water at an upright side, or in the air. Axes along which the box has
 * no extent, the third one of a plane, do not count; eps tells a box that ends on the domain's side
 * from one that ends next to it. */
static bool ends_inside(const struct scene *c, int up, double box[2][3])
{
    const struct scene_domain *d = &c->domain;
    const bool falls = c->fluid.gravity[up] < 0.0; /* towards the lower side */
    bool ends = false;
    for (int a = 0; a < d->dim; a++) {
        const double eps = 1e-9 * (d->max[a] - d->min[a]);
        const bool low = box[0][a] > d->min[a] + eps, high = box[1][a] < d->max[a] - eps;
        if (box[1][a] > box[0][a])
            ends = ends || (a != up ? low || high : falls ? high : low);
    }
    return ends;
}

/* Without weight there is no upright side, and no level beside it. */
bool crossing_find(const struct run *r)
{
    double box[PARAM_PROGRAMS_MAX][2][3];
    bool ends = false;
    if (!r->coupled || !r->scene.has_sph || !r->scene.has_fv || !scene_has_surface(&r->scene))
        return false;
    const int up = scene_still_axis(&r->scene);
    if (up < 0)
        return false;
    const int n = peek_boxes(r, NULL, box);
    for (int k = 0; k < n; k++)
        ends = ends || ends_inside(&r->scene, up, box[k]);
    return ends;
}

/* Whether a gauge lies in a box, which may reach over a periodic side; one of the level, whose
 * column ends there, by its place on the ground alone. On a face of the box inside the domain there
 * are particles on one side alone, so it is the cells' there. */
static bool holds(const struct scene *c, int up, double box[2][3], const struct scene_probe *g)
{
    bool inside = true;
    for (int a = 0; a < c->domain.dim; a++)
        if (box[1][a] > box[0][a] && (a != up || probe_is_point(g))) {
            const double x = scene_image_from(&c->domain, a, box[0][a], g->at[a]);
            const double eps = 1e-9 * (box[1][a] - box[0][a]);
            const double low = box[0][a] > c->domain.min[a] + eps ? eps : -eps;
            const double high = box[1][a] < c->domain.max[a] - eps ? eps : -eps;
            inside = inside && x >= box[0][a] + low && x <= box[1][a] - high;
        }
    return inside;
}

/* Whether the box of some group of particles, this program's or another's, moves: a gauge at rest
 * may lie in it for a while. Collective. */
static bool any_moves(const struct run *r)
{
    char names[PARAM_PROGRAMS_MAX][64];
    const int n = params_programs(r->params, "sph", names);
    bool moves = false;
    for (int k = 0; k < n; k++) {
        const char *velocity = key_text(":%s.box_velocity", names[k]);
        const char *follows = key_text(":%s.box_follows", names[k]);
        moves = params_peek_any(r->params, r->comm, velocity, NULL) || moves;
        moves = params_peek_any(r->params, r->comm, follows, NULL) || moves;
    }
    return moves;
}

/* Whether the surface over a level gauge is above the box, so that the particles have none there,
 * or comes there with the crests, so that they have a part of it: water stands at the start where
 * the box ends below the domain's roof, or less than the height of the waves below that. */
static bool is_drowned(const struct scene *c, int up, double box[2][3], const struct scene_probe *g)
{
    const struct exact e = exact_create(c);
    const struct scene_domain *d = &c->domain;
    const bool falls = c->fluid.gravity[up] < 0.0;
    const double top = box[falls][up], roof = falls ? d->max[up] : d->min[up],
                 eps = 1e-9 * (d->max[up] - d->min[up]);
    double x[3];
    memcpy(x, g->at, sizeof x);
    x[up] = top;
    if (c->has_waves && fabs(top - roof) > eps)
        x[up] -= copysign(c->waves.height, roof - top);
    return scene_is_fluid(c, &e, x, NULL);
}

/* How a section, or the rectangle that it spans, lies to a box: all of it in it, or a part. One
 * that runs along a face of the box lies outside. */
static void section_in(const struct scene *c, double box[2][3], const struct scene_probe *g,
                       bool *all, bool *part)
{
    *all = *part = true;
    for (int a = 0; a < c->domain.dim; a++) {
        if (box[1][a] <= box[0][a])
            continue;
        const double eps = 1e-9 * (box[1][a] - box[0][a]), from = fmin(g->at[a], g->to[a]);
        const double lo = scene_image_from(&c->domain, a, box[0][a] - eps, from);
        const double hi = lo + fabs(g->to[a] - g->at[a]);
        *part = *part && scene_ranges_meet(&c->domain, a, box[0][a] + eps, box[1][a] - eps, lo, hi);
        *all = *all && lo >= box[0][a] - eps && hi <= box[1][a] + eps;
    }
    *all = *all && *part;
}

/* A discharge is the one of one program, so no box may hold a part of its section, nor run away. */
static void deal_section(struct run *r, int k, double box[PARAM_PROGRAMS_MAX][2][3], int n,
                         struct faults *f)
{
    const struct scene_probe *g = r->scene.probes + k;
    const bool particles = strncmp(r->name, "sph", 3) == 0;
    bool inside = false;
    const char *key = key_text("probes.[%d].at", k);
    if (any_moves(r))
        params_fault(r->params, f, key,
                     "%s: a discharge is read by one program, and the box of the particles moves: "
                     "leave the gauge out, or hold the box",
                     g->name);
    for (int q = 0; q < n; q++) {
        bool all, part;
        section_in(&r->scene, box[q], g, &all, &part);
        inside = inside || all;
        if (part && !all)
            params_fault(r->params, f, key,
                         "%s: a discharge is read by one program: end its section at the box of "
                         "the particles, (%g, %g) to (%g, %g) m, and give the rest as another "
                         "gauge, or move it",
                         g->name, box[q][0][0], box[q][0][1], box[q][1][0], box[q][1][1]);
    }
    r->gauge_elsewhere[k] = inside != particles;
}

/* A gauge is read here unless gauge_elsewhere says otherwise, by SPH or by FV, but not by both,
 * except points where a box moves (`both'). */
void crossing_deal(struct run *r, struct faults *f)
{
    const struct scene *c = &r->scene;
    const int up = scene_still_axis(c);
    const bool shared = r->coupled && c->has_sph && c->has_fv,
               particles = strncmp(r->name, "sph", 3) == 0;
    double box[PARAM_PROGRAMS_MAX][2][3];
    const int n = shared ? peek_boxes(r, particles ? r->name : NULL, box) : 0;
    const bool both = !shared || (!r->crossed && any_moves(r));
    for (int k = 0; k < c->nprobes; k++) {
        const struct scene_probe *g = c->probes + k;
        bool inside = false;
        if (shared && g->kind == PROBE_DISCHARGE) {
            deal_section(r, k, box, n, f);
            continue;
        }
        for (int q = 0; q < n; q++)
            inside = inside || (holds(c, up, box[q], g) && !(g->kind == PROBE_LEVEL && up >= 0 &&
                                                             is_drowned(c, up, box[q], g)));
        if (shared && (g->body[0] || (!r->crossed && !probe_is_point(g))))
            r->gauge_elsewhere[k] = !particles; /* what moves, and a surface that is theirs alone */
        else
            r->gauge_elsewhere[k] = !both && inside != particles;
    }
}

double crossing_time(const struct scene *c)
{
    double g[3];
    const double size = scene_still_gravity(c, g);
    const int up = scene_still_axis(c);
    return up < 0 ? INFINITY : sqrt(crossing_depth(c, up) / size);
}

/* Height of the highest point of shape k, or of the water below a level, along sign times axis a;
 * infinite where the shape goes through. */
static double top_of(const struct scene *c, int k, int a, double sign)
{
    const struct scene_shape *h = c->shapes + k;
    const struct scene_mesh *m = scene_mesh_of(c, MESH_OF_SHAPE, k);
    double lo[3], hi[3];
    if (h->form == SHAPE_BELOW)
        return h->level;
    scene_shape_extent(h, lo, hi);
    return sign > 0.0 ? (m ? m->hi : hi)[a] : -(m ? m->lo : lo)[a];
}

/* In the direction against gravity: sign turns the axis where gravity points along it, so that
 * floor, roof and all heights grow upward. */
double crossing_depth(const struct scene *c, int a)
{
    const double sign = c->fluid.gravity[a] > 0.0 ? -1.0 : 1.0; /* heights are against gravity */
    const double floor = sign > 0.0 ? c->domain.min[a] : -c->domain.max[a];
    const double roof = sign > 0.0 ? c->domain.max[a] : -c->domain.min[a];
    double top = c->nshapes > 0 ? floor : roof;
    if (c->initial.level < LEVEL_TOP)
        return c->initial.level - floor;
    for (int k = 0; k < c->nshapes; k++)
        if (!c->shapes[k].hole)
            top = fmax(top, top_of(c, k, a, sign));
    return fmin(top, roof) - floor;
}
