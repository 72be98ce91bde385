/* body_seal.c - solids that touch: a free body that has rested on something since the start, and,
 * found by body_wedge.c, bodies that stay where they are. No particle is in the last spacings of a
 * wedge or slit between them, yet real faces are rough and water seeps in.
 *
 * Of a uniform pressure p a face gets 2 p W_y at its place y from the particles' wall terms, W_y
 * the kernel sum there. Alone in the fluid a body b has W_y = 1 - b_y (b_y: the kernel's part
 * behind its own faces), and its surface gets p n, for the integral of (1 - 2 b_y) n over it is 0.
 * So beside another solid it lacks 2 p (1 - b_y - W_y) n where the kernel reaches behind that one:
 * what the other keeps out and what no particle is there for. Where the other lies on it, and there
 * is no water, it gets (1 - 2 b_y) p n, so that the integral is whole. It gets that, and the other
 * the opposite, with p of the particles around y, or, where these are less than half of what there
 * is room for, as far as they are missing the pressure of water at rest that has the pressure of
 * the wet surface around. Between faces that no sharp wedge or slit parts wall_gap.c does the same
 * by particles. SPDX-License-Identifier: BSD-3-Clause */
#include "body_seal.h"

#include "bodies.h"
#include "body_touch.h"
#include "seal_openings.h"

static const double enough = 0.5, open_share = 0.02, open_room = 0.1; /* - */
static const double close_by = 0.1, flat = 0.9995; /* dx; -: faces that lie on each other */

/* Level of refinement that flows at x. */
static const struct sph *level_at(const struct sph *s, const double *x)
{
    const struct sph *at = s;
    for (const struct sph *q = s->finer; q; q = q->finer)
        if (!q->places || q->places->flows(q, x))
            at = q;
    return at;
}

/* Shares of the kernel at a node, a little way into the fluid; what is owed goes by the others that
 * come later, so that each pair is pressed once, or by all of them, what is reached by all. Where
 * there is no room for particles they press by no other rule, so there all that the kernel reaches
 * counts, as the floor below a slab of 2 dx and the block on it. false: the others are out of
 * reach. */
static bool measure(const struct sph *s, int body, bool all, struct seal_point *to)
{
    const struct walls *w = s->walls;
    const struct sph *at = level_at(s, to->is.x);
    double x[3] = {0.0, 0.0, 0.0}, out[3];
    for (int a = 0; a < s->dim; a++)
        x[a] = to->is.x[a] - 1e-4 * at->R * to->is.n[a];
    to->level = at->level;
    double share[BODIES_MAX + 1], all_reach = 0.0, pressed = 0.0;
    to->lack = to->room = 1.0 - wall_share(at, body, x);
    for (int k = -1; k < w->nbodies; k++) {
        share[k + 1] = k == body ? 0.0 : wall_share(at, k, x);
        to->room -= share[k + 1];
    }
    for (int k = -1; k < w->nbodies; k++) {
        const bool faces = k != body && (walls_sealed(s, body, k) || to->room < open_room);
        const bool seals = faces && (all || k < 0 || k > body);
        to->reached = fmax(to->reached, faces ? share[k + 1] : 0.0);
        all_reach += faces ? share[k + 1] : 0.0;
        pressed += seals ? share[k + 1] : 0.0;
        if (!seals)
            to->lack -= share[k + 1];
        if (!seals || !(share[k + 1] > 0.0) || to->nothers == SEAL_OTHERS)
            continue;
        struct seal_other *o = to->other + to->nothers++;
        *o = (struct seal_other){.body = k, .share = share[k + 1]};
        wall_share_weight(at, k, to->is.x, to->is.n, o->weight);
        const double r = touch_distance(w, s->dim, k, to->is.x, close_by * at->dx, out);
        o->lies_on = r < walls_shut(w, body, k) * at->dx && vec3_dot(out, to->is.n) > flat;
        to->dry = to->dry || o->lies_on;
    }
    to->part = pressed < all_reach ? pressed / all_reach : 1.0;
    to->lack -= (1.0 - to->part) * fmax(to->room, 0.0);
    return to->reached > 1e-6;
}

/* The rim is open to the water, and the others hardly matter there. Of a body all of whose open
 * faces they reach, as a block of R between a floor and another as wide, it is where they matter
 * least: without one no water seeped in, and the upper block bore what is above it. */
static void mark_rim(struct seal_point *of, int n)
{
    double least = INFINITY;
    for (int k = 0; k < n; k++) {
        of[k].rim = !of[k].dry && of[k].room > fmax(of[k].reached, open_room);
        least = of[k].rim ? fmin(least, of[k].reached) : least;
    }
    for (int k = 0; k < n; k++)
        of[k].rim = of[k].rim && of[k].reached < fmax(open_share, 1.5 * least);
}

/* How much a point goes by what is around it itself: the pressure of rows between two faces errs by
 * some per cent, that of the rim does not; but far from it the water in a slit flows. */
static void find_far(const struct sph *s, struct seal_point *of, int n)
{
    mark_rim(of, n);
    for (int k = 0; k < n; k++) {
        const double R = level_at(s, of[k].is.x)->R;
        double least = INFINITY, e[3];
        for (int m = 0; m < n; m++)
            if (of[m].rim) {
                vec3_from(of[k].is.x, of[m].is.x, e);
                least = fmin(least, vec3_dot(e, e));
            }
        of[k].far = fmax(0.0, fmin(sqrt(least) / R - 2.0, 1.0));
    }
    seal_openings_find(s, of, n);
}

/* Appends the points of a body that face others with which it is sealed (walls->sealed), of two
 * bodies those of the first alone, or `all'. */
static void add_points(const struct sph *s, int body, bool all, struct seal_point **of, int *n)
{
    const struct nodes nodes = body_nodes_lay(s, body);
    ROOM_IN(NULL, *of, *n + nodes.n);
    for (int k = 0; k < nodes.n; k++) {
        struct seal_point *to = *of + *n;
        *to = (struct seal_point){.is = nodes.node[k], .body = body};
        to->is.around = true;
        *n += measure(s, body, all, to);
    }
    mem_free(nodes.node);
}

/* The points of a body, and, for their rim, of the bodies with which it is sealed, into *of, owned
 * by the caller; returns their number. A slab of 2 dx between blocks has no open face of its own.
 */
static int lay_points(const struct sph *s, int body, struct seal_point **of)
{
    int n = 0, kept = 0;
    add_points(s, body, false, of, &n);
    for (int k = 0, own = n; k < s->walls->nbodies && own > 0; k++)
        if (k != body && walls_sealed(s, body, k))
            add_points(s, k, true, of, &n);
    find_far(s, *of, n);
    for (int k = 0; k < n; k++)
        if (((*of)[k].body == body && (*of)[k].nothers > 0) || (*of)[k].rim)
            (*of)[kept++] = (*of)[k];
    return kept;
}

/* Share of the water at a point that particles are there for, 0 to 1. */
static double wetness(const struct seal_point *p, const struct average_node *d)
{
    return fmin(d->said.W / fmax(enough * p->room, 1e-6), 1.0);
}

/* A weight within a tenth of the room counts as the room itself: rows of particles miss it by that
 * much. */
static double pressure_at(const struct seal_point *p, const struct average_node *d)
{
    const double slack = 0.1 * p->room, W = d->said.W;
    const double by = p->room + fmax(W - p->room - slack, 0.0) + fmin(W - p->room + slack, 0.0);
    return d->said.P / fmax(by, fmax(enough * p->room, 1e-6));
}

/* The water at a place: pressure, and how wet it is there, from 0 in air to 1. */
struct seep {
    double p, wet; /* Pa; - */
};

/* Of the wet surface around: place, weight, water there. */
struct rim {
    double x[3], area;
    int opening;
    struct seep is;
};

static int find_rim(const struct seal_point *of, const struct nodes *at, struct rim *rim)
{
    int n = 0;
    for (int k = 0; k < at->n; k++) {
        const struct average_node *d = at->node + k;
        if (of[k].rim)
            rim[n++] = (struct rim){.x = {d->x[0], d->x[1], d->x[2]},
                                    .area = d->area,
                                    .opening = of[k].opening,
                                    .is = {pressure_at(of + k, d), wetness(of + k, d)}};
    }
    return n;
}

/* At rest, with the pressures of the rim, those nearer with more weight; where the rim stands in
 * air there is none. */
static struct seep seep_from_rim(const struct sph *s, const struct rim *rim, int n,
                                 const struct seal_point *to)
{
    const double *x = to->is.x;
    const double near = 0.0625 * s->dx * s->dx, *g = s->gravity;
    struct seep sum = {0.0, 0.0};
    double weight = 0.0;
    for (int k = 0; k < n; k++) {
        const struct rim *r = rim + k;
        const double e[3] = {x[0] - r->x[0], x[1] - r->x[1], s->dim == 3 ? x[2] - r->x[2] : 0.0};
        const double r2 = e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + near;
        const double W = to->from[r->opening] * r->area / (s->dim == 3 ? r2 * r2 : r2);
        const double p = r->is.p + r->is.wet * s->rho0 * (g[0] * e[0] + g[1] * e[1] + g[2] * e[2]);
        sum.p += W * (s->surface ? fmax(p, fmin(r->is.p, 0.0)) : p); /* nothing hangs in the air */
        sum.wet += W * r->is.wet;
        weight += W;
    }
    return weight > 0.0 ? (struct seep){sum.p / weight, sum.wet / weight} : sum;
}

/* The water at a point of the surface with these particles around, or what of it seeps in. */
static struct seep water_at(const struct sph *s, const struct seal_point *p,
                            const struct average_node *d, const struct rim *rim, int nrim)
{
    const double own = p->dry   ? 0.0
                       : p->rim ? 1.0
                                : p->far,
                 wet = wetness(p, d), dry = 1.0 - own * wet;
    struct seep is = {own * pressure_at(p, d), own * wet};
    if (dry > 0.0 && !p->rim) {
        const struct seep seeps = seep_from_rim(s, rim, nrim, p);
        is.p += dry * seeps.p;
        is.wet += dry * seeps.wet;
    }
    return is;
}

/* q is what the point lacks: 2 p (1 - b_y), or where another lies on it p (1 - 2 b_y), less what
 * particles give already, of both the part that no earlier body of a pair presses; the rest is what
 * the water's weight changes of that (wall_share_weight). Of several others each gives by its share
 * of the kernel, what lies on the point what is left: to a slab of 1 dx on the floor the block on
 * it would else be given the floor's part. */
static void press(struct sph *s, const struct seal_point *p, const struct average_node *d,
                  const struct seep *is)
{
    const double q = 2.0 * p->lack * is->p - (p->dry ? is->p : 2.0 * p->part * d->said.P);
    double f[3], back[3], shares = 0.0;
    for (int k = 0; k < p->nothers; k++)
        shares += p->other[k].share;
    for (int k = 0; k < p->nothers; k++) {
        const struct seal_other *o = p->other + k;
        double by = o->share / shares * q;
        if (p->dry)
            by = 2.0 * o->share * is->p + (o->lies_on ? q - 2.0 * shares * is->p : 0.0);
        for (int a = 0; a < 3; a++) {
            f[a] = d->area * (by * d->n[a] + is->wet * s->rho0 * o->weight[a]);
            back[a] = -f[a];
        }
        forces_add(s, p->body, d->x, f);
        forces_add(s, o->body, d->x, back);
    }
}

/* The nearest of those whose faces it may be on. */
static const struct wall_joint *joint_at(const struct sph *s, const double *x)
{
    const struct wall_joints *j = s->walls->joints;
    const struct wall_joint *nearest = NULL;
    double least = 2.0 * s->R;
    for (int k = 0; j && k < j->n; k++) {
        const double r = hypot(x[0] - j->of[k].x[0], x[1] - j->of[k].x[1]);
        if (r < least) {
            least = r;
            nearest = j->of + k;
        }
    }
    return nearest;
}

/* Asks the points [n] of one body what is around them, into *at, and finds the water there; both
 * are the caller's. Collective. */
static struct seep *find_water(const struct sph *s, const struct seal_point *of, int n,
                               struct nodes *at)
{
    struct seep *is = NEW(struct seep, n);
    struct rim *rim = NEW(struct rim, n);
    *at = (struct nodes){.n = n, .node = NEW(struct average_node, n)};
    for (int k = 0; k < n; k++) {
        at->node[k] = of[k].is;
        at->node[k].joint = joint_at(s, of[k].is.x);
    }
    body_nodes_ask(s, at);
    const int nrim = find_rim(of, at, rim);
    for (int k = 0; k < n; k++)
        is[k] = water_at(s, of + k, at->node + k, rim, nrim);
    mem_free(rim);
    return is;
}

/* Presses those of the points [n] that are of the first's body, and their others with the opposite.
 * Collective; rank 0 alone reports forces, for points are the same on all ranks. */
static void press_points(struct sph *s, const struct seal_point *of, int n)
{
    struct nodes at;
    struct seep *is = find_water(s, of, n, &at);
    for (int k = 0; k < n && s->run->rank == 0; k++)
        if (of[k].body == of->body)
            press(s, of + k, at.node + k, is + k);
    FREE(is, at.node);
}

/* Whether a body is sealed with anything. */
static bool is_sealed(const struct walls *w, int body)
{
    bool any = false;
    for (int k = 0; k <= BODIES_MAX; k++)
        any = any || w->sealed[body][k];
    return any;
}

void seal_nodes_fill(const struct sph *s, int body, struct nodes *nodes)
{
    if (!is_sealed(s->walls, body))
        return;
    struct seal_point *of = NEW(struct seal_point, nodes->n);
    int n = 0, *node = NEW(int, nodes->n);
    for (int k = 0; k < nodes->n; k++) {
        of[n] = (struct seal_point){.is = nodes->node[k], .body = body};
        of[n].is.said = (struct said){.W = 0.0};
        of[n].is.around = true;
        node[n] = k;
        n += measure(s, body, true, of + n);
    }
    find_far(s, of, n);
    struct nodes at;
    struct seep *is = find_water(s, of, n, &at);
    for (int k = 0; k < n; k++) {
        struct said *said = &nodes->node[node[k]].said;
        said->W = fmax(said->W, AVERAGE_WET);
        said->P = of[k].dry ? 0.0 : said->W * is[k].p;
    }
    FREE(of, node, is, at.node);
}

void seals_mark(struct walls *w, int body)
{
    for (int k = body; k <= BODIES_MAX; k++) {
        const bool first = k == BODIES_MAX || !w->bodies[k].free || w->bodies[body].free;
        const double gap = first ? w->start_gap[body][k] : w->start_gap[k][body];
        const bool other = k == BODIES_MAX || (k < w->nbodies && k != body);
        if (!other || !(w->bodies[body].free || (k < w->nbodies && w->bodies[k].free)))
            continue;
        w->sealed[body][k] = w->sealed[k][body] = isfinite(gap);
    }
}

/* Whether body k, or its image across a period, may be within R of the other. */
static bool is_near(const struct sph *s, int body, int k)
{
    const struct body *b = s->walls->bodies + body, *c = s->walls->bodies + k;
    double e[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < s->dim; a++) {
        e[a] = body_centre(c, a) - body_centre(b, a);
        e[a] = s->periodic[a] ? remainder(e[a], s->hi[a] - s->lo[a]) : e[a];
    }
    return c->bend || vec3_length(e) < b->reach + c->reach + s->R;
}

/* Along each axis at the distance of the body's reach: no rotation leaves all three where they
 * were. */
static void find_places(const struct sph *s, int body, struct seal_rest *to)
{
    for (int k = 0; k < s->walls->nbodies; k++) {
        const struct body *b = s->walls->bodies + k;
        to->near[k] = is_near(s, body, k);
        for (int a = 0; a < 3; a++) {
            double x[3] = {b->centre[0], b->centre[1], b->centre[2]};
            x[a] += a < b->dim ? b->reach : 0.0;
            to->at[k][a][2] = 0.0;
            body_place(b, x, to->at[k][a]);
        }
    }
}

/* Whether none of those near has moved since, in 3D by more than 0.02 dx. In 2D measuring is cheap,
 * and a run that begins at a restart file has the same bits. */
static bool is_as_measured(const struct sph *s, int body, const struct seal_rest *rest)
{
    struct seal_rest now;
    double e[3], most = 0.0;
    find_places(s, body, &now);
    for (int k = 0; k < s->walls->nbodies; k++)
        for (int a = 0; a < 3 && (now.near[k] || rest->near[k]); a++) {
            vec3_from(rest->at[k][a], now.at[k][a], e);
            most = fmax(most, s->walls->bodies[k].bend ? INFINITY : vec3_length(e));
        }
    bool same = most <= (s->dim == 3 ? 0.02 * s->dx : 0.0);
    for (int k = 0; k < rest->n && s->finer && same; k++)
        same = level_at(s, rest->of[k].is.x)->level == rest->of[k].level;
    return same;
}

static const struct seal_rest *rest_of(const struct sph *s, int body)
{
    struct walls *w = s->walls;
    struct seal_point *of = NULL;
    if (w->rest[body] && is_as_measured(s, body, w->rest[body]))
        return w->rest[body];
    mem_free(w->rest[body]);
    const int n = lay_points(s, body, &of);
    struct seal_rest *to = mem_new_in(w, 1, sizeof *to + (size_t)n * sizeof *of);
    find_places(s, body, to);
    to->n = n;
    if (n > 0)
        memcpy(to->of, of, (size_t)n * sizeof *of);
    mem_free(of);
    return w->rest[body] = to;
}

/* A body's points are pressed once, whether it is sealed with one that is free, or with what stays
 * where it is, or both. */
void body_seals_add(struct sph *s)
{
    struct walls *w = s->walls;
    for (int k = 0; w && w->any_free && k < w->nbodies; k++)
        seals_mark(w, k);
    for (int k = 0; w && k < w->nbodies; k++) {
        const bool sealed = w->any_free && is_sealed(w, k);
        const struct seal_rest *rest = sealed || w->wedged[k] ? rest_of(s, k) : NULL;
        if (rest && rest->n > 0)
            press_points(s, rest->of, rest->n);
    }
}
