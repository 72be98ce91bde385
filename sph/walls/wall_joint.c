/* wall_joint.c - see wall_joint.h. From a joint the walls leave as rays, sorted by angle; between
 * two that face each other is a fluid. A joint has two fluids or more.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wall_joint.h"

enum { JOINT_RAYS = 16 };

static const double least_angle = 0.02; /* rad: less is no fluid but a face on a face */

/* What leaves a joint along a segment, to its end b (on: the fluid is on the left) or a. */
struct ray {
    int piece, body;
    bool on;
    double angle, from, to; /* m along the segment */
};

/* Joints of what never moves are found once. */
static bool is_fixed(const struct walls *w, const struct segment *g)
{
    return g->body < 0 || !w->bodies[g->body].moves;
}

/* Distance of x from a segment, the place of its foot along it, both in m. */
static double distance_to(const struct segment *g, const double *x, double *along)
{
    const double d[2] = {x[0] - g->a[0], x[1] - g->a[1]};
    *along = fmax(0.0, fmin(d[0] * g->t[0] + d[1] * g->t[1], g->length));
    return hypot(d[0] - *along * g->t[0], d[1] - *along * g->t[1]);
}

/* Angle of the way along t, so that ways that are alike have angles that are. */
static double angle_of(double tx, double ty)
{
    const double angle = atan2(ty, tx);
    return angle < M_PI - least_angle ? angle : angle - 2.0 * M_PI;
}

/* Whether p comes before q counter-clockwise. Where faces of two owners lie on each other there is
 * no fluid between them: solids are before the first, which has its fluid on its left, and beyond
 * the other. */
static bool is_before(const struct ray *p, const struct ray *q)
{
    const double turn = q->angle - p->angle;
    return fabs(turn) < least_angle && p->body != q->body && p->on != q->on ? p->on : turn > 0.0;
}

static int find_rays(const struct walls *w, const double *x, double near, struct ray *ray)
{
    int n = 0;
    for (int k = 0; k < w->nsegments; k++) {
        const struct segment *g = w->segments + k;
        double at;
        if (fabs(x[0] - g->a[0]) > g->length + near || distance_to(g, x, &at) > near)
            continue;
        if (at > near && n < JOINT_RAYS)
            ray[n++] = (struct ray){k, g->body, false, angle_of(-g->t[0], -g->t[1]), 0.0, at};
        if (at < g->length - near && n < JOINT_RAYS)
            ray[n++] = (struct ray){k, g->body, true, angle_of(g->t[0], g->t[1]), at, g->length};
    }
    for (int k = 1; k < n; k++)
        for (int i = k; i > 0 && is_before(ray + i, ray + i - 1); i--) {
            const struct ray r = ray[i];
            ray[i] = ray[i - 1];
            ray[i - 1] = r;
        }
    return n;
}

static void add_face(const struct walls *w, struct wall_joint *j, int piece, int fluid, double from,
                     double to)
{
    const struct segment *g = w->segments + piece;
    struct joint_face *f = j->face + j->nfaces++;
    *f = (struct joint_face){.is = *g, .piece = piece, .fluid = fluid, .from = from, .to = to};
    for (int a = 0; a < 2; a++) {
        f->is.a[a] = g->a[a] + from * g->t[a];
        f->is.b[a] = g->a[a] + to * g->t[a];
    }
    f->is.length = to - from;
}

/* Where the wall goes on at an end of a segment: the piece, -1: nowhere. */
static int next_piece(const struct walls *w, int piece, bool on, double near)
{
    const double *x = on ? w->segments[piece].b : w->segments[piece].a;
    for (int k = 0; k < w->nsegments; k++) {
        const double *y = on ? w->segments[k].a : w->segments[k].b;
        if (k != piece && hypot(x[0] - y[0], x[1] - y[1]) < near)
            return k;
    }
    return -1;
}

/* Walks along the walls from a ray on: a piece with the part of it that lies ahead. */
struct joint_walk {
    int piece;
    double from, to, ahead; /* m along the piece; length so far, with this part */
};

static struct joint_walk walk_from(const struct ray *r)
{
    return (struct joint_walk){r->piece, r->from, r->to, r->to - r->from};
}

static void walk_on(const struct walls *w, struct joint_walk *at, bool on, double near)
{
    at->piece = next_piece(w, at->piece, on, near);
    at->from = 0.0;
    at->to = at->piece >= 0 ? w->segments[at->piece].length : 0.0;
    at->ahead += at->to;
}

/* How far the faces of a fluid go along a wall from a ray on, m: half of the way round a solid, for
 * from there on they are those of the fluid on its other side. */
static double half_way(const struct walls *w, const struct wall_joint *j, const struct ray *r,
                       double near)
{
    struct joint_walk at = walk_from(r);
    for (int k = 0; k < w->nsegments && at.piece >= 0; k++) {
        const struct segment *g = w->segments + at.piece;
        double along;
        if (k > 0 && distance_to(g, j->x, &along) < near)
            return 0.5 * (at.ahead - g->length + (r->on ? along : g->length - along));
        walk_on(w, &at, r->on, near);
    }
    return INFINITY;
}

/* The faces of a fluid from a ray on. */
static void follow_ray(const struct walls *w, struct wall_joint *j, const struct ray *r, int fluid,
                       double near, double reach)
{
    const double most = half_way(w, j, r, near);
    struct joint_walk at = walk_from(r);
    while (at.piece >= 0 && j->nfaces < JOINT_FACES) {
        const struct segment *g = w->segments + at.piece;
        const double *end = r->on ? g->b : g->a, over = fmax(0.0, at.ahead - most);
        add_face(w, j, at.piece, fluid, at.from + (r->on ? 0.0 : over),
                 at.to - (r->on ? over : 0.0));
        if (over > 0.0 || hypot(end[0] - j->x[0], end[1] - j->x[1]) > reach)
            return;
        walk_on(w, &at, r->on, near);
    }
}

/* The end of one face where another of a second fluid begins or ends, too, but for the joint. */
static void find_meets(struct wall_joint *j, const struct joint_face *f, const struct joint_face *o,
                       double near)
{
    for (int end = 0; end < 4; end++) {
        const double *x = end < 2 ? f->is.a : f->is.b, *y = end % 2 ? o->is.b : o->is.a;
        if (j->nmeets < JOINT_MEETS && hypot(x[0] - y[0], x[1] - y[1]) < near &&
            hypot(x[0] - j->x[0], x[1] - j->x[1]) > near)
            memcpy(j->meet[j->nmeets++], x, sizeof *j->meet);
    }
}

/* Whether walls part fluids at x. */
static bool make_joint(const struct walls *w, const double *x, double near, double reach,
                       struct wall_joint *j)
{
    struct ray ray[JOINT_RAYS];
    const int n = find_rays(w, x, near, ray);
    int fluid[JOINT_RAYS], nfluids = 0;
    for (int k = 0; k < n; k++) {
        const struct ray *r = ray + k, *q = ray + (k + 1) % n;
        const double turn = q->angle - r->angle,
                     width = turn < -least_angle ? turn + 2.0 * M_PI : turn;
        fluid[k] = r->on && !q->on && width > least_angle ? nfluids++ : -1;
    }
    if (nfluids < 2)
        return false;
    *j = (struct wall_joint){.x = {x[0], x[1]}, .nfluids = nfluids};
    for (int k = 0; k < n; k++)
        for (int end = 0; end < 2 && fluid[k] >= 0; end++)
            follow_ray(w, j, ray + (k + end) % n, fluid[k], near, reach);
    for (int k = 0; k < j->nfaces; k++)
        for (int m = 0; m < k; m++)
            if (j->face[k].fluid != j->face[m].fluid)
                find_meets(j, j->face + k, j->face + m, near);
    return true;
}

/* Several ends may lie in one place: it is one joint. */
static bool is_there(const struct wall_joints *to, const double *x, double near)
{
    for (int k = 0; k < to->n; k++)
        if (hypot(to->of[k].x[0] - x[0], to->of[k].x[1] - x[1]) < 2.0 * near)
            return true;
    return false;
}

static void try_at(const struct sph *s, struct wall_joints *to, const double *x)
{
    const double near = 0.1 * s->dx;
    if (is_there(to, x, near))
        return;
    ROOM_IN(NULL, to->of, to->n + 1);
    to->n += make_joint(s->walls, x, near, 2.0 * s->R, to->of + to->n);
}

/* Ends of one segment on another: of fixed ones, or of two of which one at least moves. Two of one
 * polyline that follow each other are a corner. */
static void look_at_pair(const struct sph *s, struct wall_joints *to, int k, int o, bool fixed)
{
    const struct walls *w = s->walls;
    const struct segment *g = w->segments + k, *h = w->segments + o;
    const double near = 0.1 * s->dx;
    if (k == o || (is_fixed(w, g) && is_fixed(w, h)) != fixed || (!fixed && g->body == h->body))
        return;
    for (int end = 0; end < 2; end++) {
        const double *x = end ? g->b : g->a, *follows = end ? h->a : h->b;
        double at;
        if (x[0] == follows[0] && x[1] == follows[1])
            continue;
        if (fabs(x[0] - h->a[0]) < h->length + near && fabs(x[1] - h->a[1]) < h->length + near &&
            distance_to(h, x, &at) < near)
            try_at(s, to, x);
    }
}

/* Whether joints have to be found anew in each step. */
static bool any_moves(const struct walls *w)
{
    bool any = false;
    for (int k = 0; k < w->nbodies; k++)
        any = any || w->bodies[k].moves;
    return any;
}

void wall_joints_find(const struct sph *s, struct wall_joints *to)
{
    const struct walls *w = s->walls;
    const bool moves = any_moves(w);
    if (to->known && !moves)
        return;
    to->n = to->nfixed;
    for (int k = 0; k < w->nsegments && !to->known; k++)
        for (int o = 0; o < w->nsegments; o++)
            look_at_pair(s, to, k, o, true);
    to->nfixed = to->n;
    to->known = true;
    for (int k = 0; k < w->nsegments; k++)
        for (int o = 0; o < w->nsegments && !is_fixed(w, w->segments + k); o++) {
            look_at_pair(s, to, k, o, false);
            look_at_pair(s, to, o, k, false);
        }
}

/* The fluid whose faces are nearest of those that show x their front; of those that show their back
 * if x is behind all. */
int wall_joint_fluid(const struct wall_joint *j, const double *x)
{
    int nearest[2] = {0, -1};
    double least[2] = {INFINITY, INFINITY};
    for (int fluid = 0; fluid < j->nfluids; fluid++) {
        struct wall_side side = wall_side_none(INFINITY);
        for (int k = 0; k < j->nfaces; k++)
            if (j->face[k].fluid == fluid)
                wall_side_add(&side, &j->face[k].is, x);
        const int front = side.distance > 0.0;
        if (fabs(side.distance) < least[front] * (1.0 - 1e-9)) {
            least[front] = fabs(side.distance);
            nearest[front] = fluid;
        }
    }
    return nearest[1] >= 0 ? nearest[1] : nearest[0];
}

/* Whether the line of sight from x to y goes through a segment, from either side. */
static bool crosses(const struct segment *g, const double *x, const double *y)
{
    const double p[2] = {x[0] - g->a[0], x[1] - g->a[1]}, q[2] = {y[0] - g->a[0], y[1] - g->a[1]};
    const double hp = p[0] * g->n[0] + p[1] * g->n[1], hq = q[0] * g->n[0] + q[1] * g->n[1];
    if ((hp > 0.0) == (hq > 0.0))
        return false;
    const double u = hp / (hp - hq), from = p[0] * g->t[0] + p[1] * g->t[1];
    const double at = from + u * (q[0] * g->t[0] + q[1] * g->t[1] - from);
    return at >= 0.0 && at <= g->length;
}

bool wall_joint_hides(const struct wall_joint *j, const double *x, const double *y)
{
    const int fx = wall_joint_fluid(j, x), fy = wall_joint_fluid(j, y);
    for (int k = 0; k < j->nfaces && fx != fy; k++) {
        const struct joint_face *f = j->face + k;
        if ((f->fluid == fx || f->fluid == fy) && crosses(&f->is, x, y))
            return true;
    }
    return false;
}

bool walls_hide(const struct sph *s, const double *x, const double *d)
{
    const struct walls *w = s->walls;
    const double r = sqrt(vec_distance2(s->dim, d, (const double[3]){0.0, 0.0, 0.0}));
    double to[3] = {0.0, 0.0, 0.0}, way[3] = {0.0, 0.0, 0.0};
    bool hidden = false;
    for (int a = 0; a < s->dim; a++) {
        way[a] = fmax(1.0 - 0.01 * s->dx / r, 0.0) * d[a];
        to[a] = x[a] + way[a];
    }
    for (int k = 0; w && w->joints && k < w->joints->n && !hidden; k++)
        hidden = wall_joint_hides(w->joints->of + k, x, to);
    return hidden || (w && walls_any_thin(w) && walls_meet(s, x, way) < 1.0);
}

const struct joint_face *wall_joint_face(const struct wall_joint *j, int piece, int fluid)
{
    for (int k = 0; k < j->nfaces; k++)
        if (j->face[k].piece == piece && j->face[k].fluid == fluid)
            return j->face + k;
    return NULL;
}

/* Whether a place of a face is nearer to where the fluids meet again than to the joint, or beyond
 * what the joint follows: over the top of a flap there is one fluid. */
static bool is_far(const struct wall_joint *j, const struct segment *g, double at, double most)
{
    const double x[2] = {g->a[0] + at * g->t[0], g->a[1] + at * g->t[1]};
    const double r = hypot(x[0] - j->x[0], x[1] - j->x[1]);
    bool far = r > most;
    for (int k = 0; k < j->nmeets; k++)
        far = far || hypot(x[0] - j->meet[k][0], x[1] - j->meet[k][1]) < r;
    return far;
}

bool wall_joint_parts(const struct wall_joint *j, const double *x, double reach)
{
    int seen = -1;
    for (int k = 0; k < j->nfaces; k++) {
        double at;
        if (j->face[k].fluid == seen || distance_to(&j->face[k].is, x, &at) >= reach ||
            is_far(j, &j->face[k].is, at, 2.0 * reach))
            continue;
        if (seen >= 0)
            return true;
        seen = j->face[k].fluid;
    }
    return false;
}
