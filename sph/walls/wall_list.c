/* wall_list.c - see wall_list.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wall_list.h"

#include "../pairs/sph_pairs.h"
#include "wall_moments.h"
#include "wall_points.h"

enum { WALL_GROUP = 8 };

/* Two places more than n: the particle to be added, and the end of the last row in `first'. */
void wall_list_room(struct wall_list *l, int touches)
{
    ROOM_IN(l->owner, l->who, l->n + 2);
    ROOM_IN(l->owner, l->first, l->n + 2);
    ROOM_IN(l->owner, l->gamma, l->n + 2);
    ROOM_IN(l->owner, l->touch, touches);
}

/* Neighbours along a polyline share a box, so that most particles are done with few of them. Boxes
 * are wider than their segments by `reach', so that the query is of the particle's point alone. */
static int lay_boxes(const struct walls *w, struct wall_list *l, double reach)
{
    const int n = (w->nsegments + WALL_GROUP - 1) / WALL_GROUP;
    ROOM_IN(l->owner, l->boxes, n);
    for (int k = 0; k < n; k++) {
        double *box = l->boxes[k];
        box[0] = box[1] = INFINITY;
        box[2] = box[3] = -INFINITY;
        for (int j = WALL_GROUP * k; j < WALL_GROUP * (k + 1) && j < w->nsegments; j++)
            for (int a = 0; a < 2; a++) {
                const struct segment *g = w->segments + j;
                box[a] = fmin(box[a], fmin(g->a[a], g->b[a]) - reach);
                box[2 + a] = fmax(box[2 + a], fmax(g->a[a], g->b[a]) + reach);
            }
    }
    return n;
}

/* Distance to the segment itself, ends included: the reach holds the support, the list's skin and
 * the way of bodies in a step. */
static bool is_near(const struct segment *g, const double *x, double reach)
{
    const double d[2] = {x[0] - g->a[0], x[1] - g->a[1]};
    const double height = d[0] * g->n[0] + d[1] * g->n[1];
    double out = d[0] * g->t[0] + d[1] * g->t[1];
    out = out < 0.0 ? -out : out > g->length ? out - g->length : 0.0;
    return height * height + out * out < reach * reach;
}

/* The segments of one group near x, behind the first n; returns how many there are then. */
static int list_group(const struct walls *w, struct wall_list *l, int group, const double *x,
                      double reach, int n)
{
    const double *box = l->boxes[group];
    if (x[0] < box[0] || x[1] < box[1] || x[0] > box[2] || x[1] > box[3])
        return n;
    wall_list_room(l, n + WALL_GROUP);
    for (int k = WALL_GROUP * group; k < WALL_GROUP * (group + 1) && k < w->nsegments; k++)
        if (is_near(w->segments + k, x, reach))
            l->touch[n++] = (struct wall_touch){.piece = k,
                                                .of = -1,
                                                .on = -1,
                                                .plane = -1, /* segments in one line are one */
                                                .body = w->segments[k].body,
                                                .friction = w->segments[k].friction,
                                                .no_slip = w->segments[k].no_slip};
    return n;
}

/* --- joints --- */

/* Of the part of a segment that touch t has, that from `from' to `to' is left. Parts are counted in
 * m along the segment. A touch that two joints cut keeps what both leave. */
static void cut_touch(struct wall_list *l, struct wall_touch *t, double from, double to)
{
    ROOM_IN(l->owner, l->cut, l->ncuts + 1);
    l->cut[l->ncuts][0] = t->of < 0 ? from : fmax(from, l->cut[t->of][0]);
    l->cut[l->ncuts][1] = t->of < 0 ? to : fmin(to, l->cut[t->of][1]);
    t->of = l->ncuts++;
}

/* The segment of a touch, or the part of it that is seen. */
static struct segment part_of(const struct walls *w, const struct wall_list *l,
                              const struct wall_touch *t)
{
    struct segment g = w->segments[t->piece];
    for (int a = 0; t->of >= 0 && a < 2; a++) {
        g.b[a] = g.a[a] + l->cut[t->of][1] * g.t[a];
        g.a[a] += l->cut[t->of][0] * g.t[a];
    }
    g.length = t->of >= 0 ? l->cut[t->of][1] - l->cut[t->of][0] : g.length;
    return g;
}

/* Of touches [first, n) of a particle at x those go that a joint hides from it; returns the new n.
 */
static int leave_seen(const struct walls *w, struct wall_list *l, const struct wall_joint *j,
                      const double *x, int first, int n)
{
    const int fluid = wall_joint_fluid(j, x);
    int kept = first;
    for (int k = first; k < n; k++) {
        const struct wall_touch *t = l->touch + k;
        const struct joint_face *f = wall_joint_face(j, t->piece, fluid);
        bool hidden = false;
        for (int other = 0; other < j->nfluids && !f; other++)
            hidden = hidden || wall_joint_face(j, t->piece, other);
        if (hidden)
            continue;
        l->touch[kept] = *t;
        if (f && (f->from > 0.0 || f->to < w->segments[t->piece].length))
            cut_touch(l, l->touch + kept, f->from, f->to);
        kept++;
    }
    return kept;
}

/* Of the l->n-th to be, at x, with touches [first, n); returns the new n. */
static int part(const struct walls *w, struct wall_list *l, const double *x, double reach,
                int first, int n)
{
    bool any = false;
    for (int k = 0; k < l->joints.n && n > first + 1; k++) {
        if (!wall_joint_parts(l->joints.of + k, x, reach))
            continue;
        any = true;
        n = leave_seen(w, l, l->joints.of + k, x, first, n);
    }
    if (l->joints.n > 0) {
        ROOM_IN(l->owner, l->parted, l->n + 1);
        l->parted[l->n] = any;
    }
    return n;
}

/* The predicate of wall_list_cut_row in 2D: no joint hides the place x from the list's particle k.
 */
static bool sees(const struct sph *s, const struct wall_list *l, int k, const double *x)
{
    bool hidden = false;
    for (int i = 0; i < l->joints.n && !hidden; i++)
        hidden = wall_joint_hides(l->joints.of + i, prim_line(&s->p, l->who[k]), x);
    return !hidden;
}

/* The gap is filled with dummies. */
void wall_list_cut_row(const struct sph *s, const struct wall_list *l, int k, wall_sees *asked)
{
    struct neighbours *of = s->list;
    const int i = l->who[k], before = of->count[i];
    int *j = of->j + of->start[i], n = 0, tail = of->tail[i];
    for (int m = 0; m < before; m++)
        if (asked(s, l, k, prim_line(&s->p, j[m])))
            j[n++] = j[m];
        else
            tail -= m < of->tail[i];
    for (int m = n; m < before; m++)
        j[m] = s->p.capacity;
    of->count[i] = n;
    of->tail[i] = tail;
}

static bool is_parted(const struct wall_list *l, int k) { return l->joints.n > 0 && l->parted[k]; }

/* Joints move with bodies, so they are found before touches are listed; rows of the list of pairs
 * are cut last, when it is known who is parted. */
static void build(const struct sph *s, struct wall_list *l)
{
    const struct walls *w = s->walls;
    const double reach = s->R + s->lists.skin + w->speed * s->step.dt_most;
    const int groups = lay_boxes(w, l, reach);
    int touches = 0;
    l->n = 0;
    l->ncuts = 0;
    wall_joints_find(s, &l->joints);
    mem_own(l->owner, l->joints.of);
    s->walls->joints = &l->joints;
    wall_list_room(l, 0);
    for (int i = 0; i < s->p.n; i++) {
        const double *x = prim_line(&s->p, i);
        const int before = touches;
        for (int k = 0; k < groups; k++)
            touches = list_group(w, l, k, x, reach, touches);
        if (touches > before) {
            wall_list_room(l, touches);
            touches = part(w, l, x, reach, before, touches);
            l->who[l->n] = i;
            l->first[l->n++] = before;
        }
    }
    l->first[l->n] = touches;
    for (int k = 0; k < l->n; k++)
        if (is_parted(l, k))
            wall_list_cut_row(s, l, k, sees);
}

static const double *cut_of(const struct wall_list *l, const struct wall_touch *t)
{
    return t->of < 0 ? NULL : l->cut[t->of];
}

/* Whether x lies beyond an open end of g and behind its line: from there it sees no wall. */
static bool is_round(const struct segment *g, double height, double from, double to)
{
    return height < 0.0 && ((from > 0.0 && g->open[0]) || (to < 0.0 && g->open[1]));
}

/* In units of R. */
static struct wall_moments moments_of(int integrals, double height, double from, double to)
{
    if (integrals == INTEGRALS_CLOSED)
        return wall_moments(height, from, to);
    return wall_points(height, from, to, integrals == INTEGRALS_NUMERICAL);
}

/* cut: which part of g, m along it; NULL: all. Fills the touch for a particle at x: height over the
 * line, m, positive on the fluid's side, vector to the centre of weight, and both integrals, W in
 * m^-1. From beyond an open end both are 0. */
static void measure(const struct segment *g, int integrals, const double *cut, const double *x,
                    double R, struct wall_touch *t)
{
    double height, begin;
    segment_seen(g, x, &height, &begin);
    const double from = cut ? begin + cut[0] : begin, to = begin + (cut ? cut[1] : g->length);
    const struct wall_moments m = is_round(g, height, from, to)
                                      ? (struct wall_moments){0}
                                      : moments_of(integrals, height / R, from / R, to / R);
    t->height = height;
    t->foot = from <= 0.0 && to >= 0.0;
    t->distance = hypot(height, fmax(0.0, fmax(from, -to)));
    t->is.gamma = m.gamma;
    t->is.W = m.W / R;
    for (int a = 0; a < 2; a++) {
        t->n[a] = g->n[a];
        t->is.e[a] = m.along * R * g->t[a] + height * g->n[a];
    }
}

void wall_list_build(const struct sph *s, struct wall_list *l)
{
    l->measured = false;
    if (s->dim == 2)
        build(s, l);
    else
        wall_list3_build(s, l);
}

/* What `more' has goes to t, of the same plane. Weights add, centres are weighted means; the joined
 * touch is emptied but keeps its place, since fluxes are stored by touch. */
static void touch_join(struct wall_touch *t, struct wall_touch *more)
{
    const double W = t->is.W + more->is.W;
    for (int a = 0; a < 3 && W > 0.0; a++)
        t->is.e[a] = (t->is.W * t->is.e[a] + more->is.W * more->is.e[a]) / W;
    t->is.W = W;
    t->is.gamma += more->is.gamma;
    t->distance = fmin(t->distance, more->distance);
    t->foot = t->foot || more->foot;
    more->is = (struct wall_integrals){0};
    more->joined = true;
}

/* One flux a plane, wherever it is cut into pieces: what the flux has that is not linear, bounds
 * of the state at the wall and the share of the wave, else depends on the cuts, and a side of two
 * triangles is no longer its own mirror image. */
static void join_planes(struct wall_touch *touch, int n)
{
    for (int j = 0; j < n; j++) {
        struct wall_touch *t = touch + j;
        t->joined = false;
        for (int k = 0; k < j && t->plane >= 0 && !t->joined; k++)
            if (touch[k].plane == t->plane && touch[k].of == t->of && !touch[k].joined)
                touch_join(touch + k, t);
    }
}

/* A wall that ends in the open hides what lies behind it up to the line of sight through its end.
 * What this line has of the kernel beyond the end closes the sums over wall and fluid: a uniform
 * pressure pushes nobody along a wall's rim, and where x comes into the wall's own line it has all
 * that the wall has, so that nothing jumps there. */
static void add_open_ends(const struct segment *g, const double *x, double R, double *rim)
{
    for (int end = 0; end < 2; end++) {
        const double *e = end ? g->b : g->a;
        const double to[2] = {e[0] - x[0], e[1] - x[1]}, r = hypot(to[0], to[1]);
        if (!g->open[end] || r >= R || r < 1e-9 * R)
            continue;
        const double inward = end ? -1.0 : 1.0; /* along t, to where the wall is */
        const double side = inward * (to[0] * g->t[1] - to[1] * g->t[0]);
        const double W = (side < 0.0 ? -1.0 : 1.0) * wall_moments(0.0, r / R, 1.0).W / (R * r);
        rim[0] -= W * to[1];
        rim[1] += W * to[0];
    }
}

static void close_open_ends(const struct sph *s, struct wall_list *l)
{
    if (s->dim == 3 || !s->walls->any_open)
        return;
    ROOM_IN(l->owner, l->rim, l->n);
    for (int k = 0; k < l->n; k++) {
        memset(l->rim[k], 0, sizeof *l->rim);
        for (int j = l->first[k]; j < l->first[k + 1]; j++)
            if (l->touch[j].is.W > 0.0)
                add_open_ends(s->walls->segments + l->touch[j].piece, prim_line(&s->p, l->who[k]),
                              s->R, l->rim[k]);
    }
}

/* The body that the piece belongs to, whatever own_covered has made of it; -1: walls at rest. */
static int owner_of(const struct walls *w, const struct wall_touch *t, int dim)
{
    return dim == 2 ? w->segments[t->piece].body : w->meshes[t->of].body;
}

/* Whether one is the back of the other, and lies on it. */
static bool is_back_of(const struct sph *s, const struct wall_touch *t, const struct wall_touch *o)
{
    double turn = 0.0;
    if (!(t->height * o->height < 0.0 && fabs(t->height + o->height) < 0.1 * s->dx))
        return false;
    for (int a = 0; a < s->dim; a++)
        turn += t->n[a] * o->n[a];
    const int of = owner_of(s->walls, t, s->dim), on = owner_of(s->walls, o, s->dim);
    const double near = (walls_sealed(s, of, on) ? walls_shut(s->walls, of, on) : 0.1) * s->dx;
    return turn < -0.99 && fabs(t->height + o->height) < near;
}

/* Of all pieces joined with it. */
static double weight_of_plane(const struct wall_touch *begin, const struct wall_touch *t)
{
    const struct wall_touch *first = begin;
    while (t->joined && (first->of != t->of || first->plane != t->plane || first->joined))
        first++;
    return t->joined ? first->is.W : t->is.W;
}

/* Which of those in [from, to) it lies on, counted from the first: of two faces back to back within
 * the support the one lies on the other that has less of it, or of two alike the one that is seen
 * from behind. -1: on none. */
static int lies_on_one(const struct sph *s, const struct wall_touch *begin,
                       const struct wall_touch *t, const struct wall_touch *from,
                       const struct wall_touch *to)
{
    const double more = 1.0 + 1e-9;
    if (t->is.W == 0.0 && !t->joined)
        return -1;
    for (const struct wall_touch *o = from; o < to; o++) {
        if (!is_back_of(s, t, o))
            continue;
        const double mine = weight_of_plane(begin, t), other = weight_of_plane(begin, o);
        if (other > 0.0 && (t->height < 0.0 ? mine <= more * other : more * mine < other))
            return (int)(o - from);
    }
    return -1;
}

/* A face that stands on that of another owner is seen from behind by the fluid beside it, and the
 * other on through it. Together they are nothing, so both have one owner: that of the face which
 * goes on where the other ends, and one share of the wave to it. */
static void own_covered(const struct sph *s, struct wall_list *l, int k)
{
    struct wall_touch *begin = l->touch + l->first[k], *end = l->touch + l->first[k + 1], *next;
    for (struct wall_touch *t = begin; t < end; t++) {
        t->body = owner_of(s->walls, t, s->dim);
        t->on = -1;
    }
    for (struct wall_touch *run = begin; run < end; run = next) { /* of one owner */
        for (next = run; next < end && next->body == run->body; next++)
            ;
        for (struct wall_touch *t = run; t < next; t++) {
            const int before = lies_on_one(s, begin, t, begin, run);
            const int behind = before < 0 ? lies_on_one(s, begin, t, next, end) : -1;
            t->on = before >= 0 ? before : behind >= 0 ? (int)(next - begin) + behind : -1;
        }
    }
    for (struct wall_touch *t = begin; t < end; t++) {
        if (t->on < 0)
            continue;
        t->body = owner_of(s->walls, begin + t->on, s->dim);
        t->near = begin[t->on].near;
    }
}

void wall_list_measure(const struct sph *s, struct wall_list *l)
{
    const double q = 0.5 * s->dx;
    if (s->dim == 3)
        wall_list3_measure(s, l);
    for (int k = 0; k < l->n; k++) {
        const double *x = prim_line(&s->p, l->who[k]);
        double gamma = 1.0;
        for (int j = l->first[k]; j < l->first[k + 1] && s->dim == 2; j++)
            measure(s->walls->segments + l->touch[j].piece, s->prm.wall_integrals,
                    cut_of(l, l->touch + j), x, s->R, l->touch + j);
        join_planes(l->touch + l->first[k], l->first[k + 1] - l->first[k]);
        for (int j = l->first[k]; j < l->first[k + 1]; j++) {
            struct wall_touch *t = l->touch + j;
            double e2 = 0.0;
            for (int a = 0; a < s->dim; a++)
                e2 += t->is.e[a] * t->is.e[a];
            t->near = fmin(1.0, q * q / e2);
            gamma += t->is.gamma;
        }
        l->gamma[k] = gamma > wall_list_behind_from(s) ? gamma - 1.0 : gamma;
        if (s->walls->nbodies > 0)
            own_covered(s, l, k);
    }
    close_open_ends(s, l);
    l->measured = true;
}

double wall_list_weight(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                        const double *x, double R)
{
    if (s->dim == 3)
        return wall_list3_weight(s, l, t, x, R);
    struct wall_touch other;
    measure(s->walls->segments + t->piece, s->prm.wall_integrals, cut_of(l, t), x, R, &other);
    return other.is.W;
}

static bool reaches(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                    const double *x)
{
    return s->dim == 3 ? wall_list3_reaches(s, l, t, x)
                       : is_near(s->walls->segments + t->piece, x, s->R);
}

const double *wall_list_shares(const struct sph *s, struct wall_list *l, int k, int face,
                               const double *x)
{
    const int n = l->first[k + 1] - l->first[k];
    const struct wall_touch *t = l->touch + l->first[k];
    const int body = l->touch[face].body;
    bool any = false;
    for (int j = 0; j < n && !any; j++)
        any = t[j].body != body && !walls_sealed(s, body, t[j].body) && reaches(s, l, t + j, x);
    if (!any)
        return NULL;
    ROOM_IN(l->owner, l->share, n);
    ROOM_IN(l->owner, l->asked, n);
    if (s->dim == 3)
        wall_list3_shares(s, l, k, face, x);
    for (int j = 0; j < n && s->dim == 2; j++) {
        struct wall_touch there;
        measure(s->walls->segments + t[j].piece, s->prm.wall_integrals, cut_of(l, t + j), x, s->R,
                &there);
        l->share[j] = there.is.gamma;
    }
    return l->share;
}

/* Sets foot to the point of the touch's piece nearest to x; returns the distance, m. */
static double nearest_on(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                         const double *x, double *foot)
{
    if (s->dim == 3)
        return wall_list3_nearest(s, l, t, x, foot);
    const struct segment *g = s->walls->segments + t->piece;
    const double *cut = cut_of(l, t), from = cut ? cut[0] : 0.0, to = cut ? cut[1] : g->length;
    const double along = (x[0] - g->a[0]) * g->t[0] + (x[1] - g->a[1]) * g->t[1];
    for (int a = 0; a < 2; a++)
        foot[a] = g->a[a] + fmax(from, fmin(along, to)) * g->t[a];
    return hypot(foot[0] - x[0], foot[1] - x[1]);
}

int wall_list_points(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                     const double *x, double (*y)[3], double *share)
{
    static const double at[FACE_POINTS] = {-0.8611363115940526, -0.3399810435848563,
                                           0.3399810435848563, 0.8611363115940526};
    static const double gauss[FACE_POINTS] = {0.3478548451374538, 0.6521451548625461,
                                              0.6521451548625461, 0.3478548451374538};
    const struct segment g = part_of(s->walls, l, t);
    const double along = (x[0] - g.a[0]) * g.t[0] + (x[1] - g.a[1]) * g.t[1];
    const double half = sqrt(fmax(s->R * s->R - t->height * t->height, 0.0));
    const double from = fmax(0.0, along - half), to = fmin(along + half, g.length);
    double sum = 0.0;
    for (int k = 0; k < FACE_POINTS; k++) {
        const double place = 0.5 * (from + to + at[k] * (to - from));
        for (int a = 0; a < 2; a++)
            y[k][a] = g.a[a] + place * g.t[a];
        share[k] = gauss[k] * kernel_w(2, fmin(hypot(place - along, t->height), s->R), s->R);
        sum += share[k];
    }
    for (int k = 0; k < FACE_POINTS && sum > 0.0; k++)
        share[k] /= sum;
    return sum > 0.0 ? FACE_POINTS : 0;
}

void wall_list_velocity(const struct sph *s, const struct wall_touch *t, const double *x, double *u)
{
    const struct walls *w = s->walls;
    if (s->dim == 2)
        walls_velocity(w, w->segments + t->piece, x, u, NULL);
    else
        wall_mesh_velocity(w, w->meshes + t->of, x, u, NULL);
}

/* Distance of x from the walls that the k-th sees, negative behind them. */
static double distance_of(const struct sph *s, const struct wall_list *l, int k, const double *x)
{
    struct wall_side side = wall_side_none(s->R);
    for (int j = l->first[k]; j < l->first[k + 1]; j++) {
        const struct wall_touch *t = l->touch + j;
        if (t->of < 0) {
            wall_side_add(&side, s->walls->segments + t->piece, x);
            continue;
        }
        const struct segment part = part_of(s->walls, l, t);
        wall_side_add(&side, &part, x);
    }
    return side.distance;
}

int wall_list_behind(const struct sph *s, const struct wall_list *l, int *who)
{
    int n = 0;
    if (s->dim == 3)
        return wall_list3_behind(s, l, who);
    for (int k = 0; k < l->n; k++)
        if (distance_of(s, l, k, state_row(&s->p, s->p.y, l->who[k])) < 0.0)
            who[n++] = l->who[k];
    return n;
}

bool wall_list_strayed(const struct sph *s, const struct wall_list *l, int k, struct wall_foot *f)
{
    const double *x = state_row(&s->p, s->p.y, l->who[k]);
    double least = INFINITY;
    if (s->dim == 3 || !is_parted(l, k) || !(distance_of(s, l, k, x) < 0.0))
        return false;
    for (int j = l->first[k]; j < l->first[k + 1]; j++) {
        const struct wall_touch *t = l->touch + j;
        double foot[2];
        const double d = nearest_on(s, l, t, x, foot);
        if (d >= least)
            continue;
        least = d;
        *f = (struct wall_foot){.x = {foot[0], foot[1]}, .body = t->body};
        memcpy(f->n, s->walls->segments[t->piece].n, 2 * sizeof *f->n);
        wall_list_velocity(s, t, f->x, f->u);
    }
    return isfinite(least);
}
