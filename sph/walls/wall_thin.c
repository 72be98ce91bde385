/* wall_thin.c - see wall_thin.h. Rays across the solid, or the fluid, from points along each face.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wall_thin.h"

/* A segment with the fluid on its left. */
struct thin_face {
    double a[2], t[2], n[2], length; /* n out of the fluid */
    int piece;                       /* polyline, then body, then side of the domain */
    double from, total;              /* m: of a along its piece; all of a closed piece, else 0 */
};

struct faces {
    int n;
    struct thin_face *face;
    const struct scene *scene;
    bool passages; /* between different pieces, not both sides of the domain */
};

static void add_face(struct faces *f, const double *a, const double *b, struct thin_face with)
{
    const double d[2] = {b[0] - a[0], b[1] - a[1]}, length = hypot(d[0], d[1]);
    if (length <= 0.0)
        return;
    ROOM_IN(NULL, f->face, f->n + 1);
    memcpy(with.a, a, sizeof with.a);
    with.length = length;
    for (int k = 0; k < 2; k++)
        with.t[k] = d[k] / length;
    with.n[0] = with.t[1];
    with.n[1] = -with.t[0];
    f->face[f->n++] = with;
}

/* Signed, m^2: positive if the points run counter-clockwise, so that the solid is on their left and
 * they have to be taken backwards. */
static double area(const struct param_points *p)
{
    double sum = 0.0;
    for (int k = 0; k < p->n; k++) {
        const double *a = p->x[k], *b = p->x[(k + 1) % p->n];
        sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return sum;
}

/* `at' counts the length along the polyline, by which `way' measures how far apart two places are.
 */
static void add_points(struct faces *f, const struct param_points *p, bool closed, bool backwards,
                       int piece)
{
    const int first = f->n, n = closed ? p->n : p->n - 1;
    double at = 0.0;
    for (int k = 0; k < n; k++) {
        const int i = backwards ? p->n - 1 - k : k;
        const int j = backwards ? (i + p->n - 1) % p->n : (i + 1) % p->n;
        add_face(f, p->x[i], p->x[j], (struct thin_face){.piece = piece, .from = at});
        at += hypot(p->x[j][0] - p->x[i][0], p->x[j][1] - p->x[i][1]);
    }
    for (int k = first; k < f->n && closed; k++)
        f->face[k].total = at;
}

/* Sides bound the fluid only: nothing is beyond them. */
static struct faces faces_of(const struct scene *c, bool sides)
{
    struct faces f = {.scene = c};
    const double *lo = c->domain.min, *hi = c->domain.max;
    const double corner[4][2] = {{lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}};
    for (int k = 0; k < c->nwalls; k++)
        if (c->walls[k].side == SIDE_NONE)
            add_points(&f, &c->walls[k].points, c->walls[k].closed, false, k);
    for (int k = 0; k < c->nbodies; k++)
        if (!sides || !c->bodies[k].free) /* gaps to a free body close and open */
            add_points(&f, &c->bodies[k].points, true, area(&c->bodies[k].points) > 0.0,
                       WALLS_MAX + k);
    for (int k = 0; sides && k < c->nwalls; k++) {
        static const int start[] = {3, 1, 0, 2}; /* x_min, x_max, y_min, y_max */
        const int side = c->walls[k].side - SIDE_X_MIN;
        if (c->walls[k].side == SIDE_NONE || side > 3 || c->walls[k].kind > WALL_NO_SLIP)
            continue;
        add_face(&f, corner[start[side]], corner[(start[side] + 1) % 4],
                 (struct thin_face){.piece = k});
    }
    return f;
}

/* First face that the ray from x along d meets within `least'; its distance, or INFINITY. */
static double cast(const struct faces *f, int own, const double *x, const double *d, double least,
                   int *hit)
{
    double nearest = INFINITY;
    for (int k = 0; k < f->n; k++) {
        const struct thin_face *g = f->face + k;
        const double across = d[0] * g->n[0] + d[1] * g->n[1];
        const double r[2] = {g->a[0] - x[0], g->a[1] - x[1]};
        if (k == own || fabs(across) < 1e-9)
            continue;
        const double t = (r[0] * g->n[0] + r[1] * g->n[1]) / across;
        const double s = (t * d[0] - r[0]) * g->t[0] + (t * d[1] - r[1]) * g->t[1];
        if (t < 0.0 || t > least || t >= nearest || s < -1e-9 * g->length ||
            s > g->length * (1.0 + 1e-9))
            continue;
        nearest = t;
        *hit = k;
    }
    return nearest;
}

/* Whether the end u of face p lies on face q; where, in m along q. */
static bool joins(const struct thin_face *p, double u, const struct thin_face *q, double *v)
{
    const double d[2] = {p->a[0] + u * p->t[0] - q->a[0], p->a[1] + u * p->t[1] - q->a[1]};
    *v = fmax(0.0, fmin(d[0] * q->t[0] + d[1] * q->t[1], q->length));
    return hypot(d[0] - *v * q->t[0], d[1] - *v * q->t[1]) < 1e-6 * (p->length + q->length);
}

/* Way along the walls between the point s of face g and the point r of face h, m; over the place
 * where their pieces meet, if they do. */
static double way(const struct faces *f, const struct thin_face *g, double s,
                  const struct thin_face *h, double r)
{
    double least = INFINITY, u, v;
    if (g->piece == h->piece) {
        const double d = fabs(g->from + s - h->from - r);
        return g->total > 0.0 ? fmin(d, g->total - d) : d;
    }
    for (const struct thin_face *p = f->face; p < f->face + f->n; p++)
        for (const struct thin_face *q = f->face; q < f->face + f->n; q++)
            for (int e = 0; p->piece == g->piece && q->piece == h->piece && e < 4; e++) {
                const double end = e % 2 * (e < 2 ? p->length : q->length);
                const bool meet = e < 2 ? joins(p, u = end, q, &v) : joins(q, v = end, p, &u);
                if (meet)
                    least = fmin(least,
                                 fabs(g->from + s - p->from - u) + fabs(h->from + r - q->from - v));
            }
    return least;
}

/* Two faces that run together to a point are a corner, however sharp: the way round it is what the
 * angle says. Nor is it a wall where the way round is as short as across. Pieces that touch in a
 * wedge that opens to 4 degrees or more, seen from its tip, are one, too: a disc on the floor. */
static bool is_corner(const struct faces *f, const struct thin_face *g, double s,
                      const struct thin_face *h, double width)
{
    const double x[2] = {g->a[0] + s * g->t[0] - h->a[0], g->a[1] + s * g->t[1] - h->a[1]};
    const double r = fmax(0.0, fmin(x[0] * h->t[0] + x[1] * h->t[1], h->length));
    const double round = way(f, g, s, h, r);
    const double cosine = -(g->n[0] * h->n[0] + g->n[1] * h->n[1]);
    const double sine = fabs(g->n[0] * h->n[1] - g->n[1] * h->n[0]);
    const bool opens = g->piece != h->piece && sine > 0.034 && width > 0.034 * round;
    return opens || round < 3.0 * width ||
           (sine > 0.08 && round < 1.5 * width * (1.0 + cosine) / sine); /* 5 degrees */
}

static void name_face(const struct scene *c, const struct thin_face *g, char *text, size_t size)
{
    if (g->piece >= WALLS_MAX)
        snprintf(text, size, "body %d (%.30s)", g->piece - WALLS_MAX + 1,
                 c->bodies[g->piece - WALLS_MAX].name);
    else
        snprintf(text, size, "wall %d", g->piece + 1);
}

static bool is_side(const struct scene *c, const struct thin_face *g)
{
    return g->piece < WALLS_MAX && c->walls[g->piece].side != SIDE_NONE;
}

/* Between faces of one piece, or two sides of the domain, there is a room but no passage that leads
 * from one water to another. */
static bool is_no_passage(const struct faces *f, const struct thin_face *g,
                          const struct thin_face *h)
{
    return f->passages && (g->piece == h->piece || (is_side(f->scene, g) && is_side(f->scene, h)));
}

/* Whether the middle x of a passage sees water and a dry place within one and a half widths at the
 * start: between two waters at rest, or in the air, nothing is known of a flow. */
static bool leads_out(const struct faces *f, const double *x, double width)
{
    enum { WAYS = 16 };
    const struct scene_domain *in = &f->scene->domain;
    const struct exact e = exact_create(f->scene);
    bool wet = false, dry = false;
    for (int k = 0; k < 3 * WAYS && !(wet && dry); k++) {
        const double angle = 2.0 * M_PI * k / WAYS, r = 0.5 * (1 + k / WAYS) * width;
        const double d[2] = {cos(angle), sin(angle)};
        const double y[3] = {x[0] + r * d[0], x[1] + r * d[1], 0.0};
        int hit;
        if (y[0] < in->min[0] || y[1] < in->min[1] || y[0] > in->max[0] || y[1] > in->max[1] ||
            !scene_is_room(f->scene, y) || isfinite(cast(f, -1, x, d, r, &hit)))
            continue;
        const bool fluid = scene_is_fluid(f->scene, &e, y, NULL);
        wet = wet || fluid;
        dry = dry || !fluid;
    }
    return wet && dry;
}

/* Whether fluid can come to a face at x: not where it lies on a side of the domain or on another
 * solid, nearer than any particle fits. */
static bool is_wetted(const struct faces *f, int k, const double *x, double least)
{
    const struct scene *c = f->scene;
    const double *n = f->face[k].n, near = 0.1 * least, to_fluid[2] = {-n[0], -n[1]};
    const double y[3] = {x[0] - near * n[0], x[1] - near * n[1], 0.0};
    const double from[2] = {x[0] + 0.01 * near * n[0], x[1] + 0.01 * near * n[1]};
    int hit;
    bool in = scene_is_room(c, y) && !isfinite(cast(f, k, from, to_fluid, near, &hit));
    for (int a = 0; a < 2; a++)
        in = in && (c->domain.periodic[a] || (y[a] > c->domain.min[a] && y[a] < c->domain.max[a]));
    return in;
}

/* Whether across the solid (into = 1) or the fluid (-1) something faces the point s of face k. */
static bool is_thin(const struct faces *f, int k, double s, int into, double least,
                    struct wall_thin *t)
{
    const struct thin_face *g = f->face + k;
    const double x[2] = {g->a[0] + s * g->t[0], g->a[1] + s * g->t[1]};
    const double d[2] = {into * g->n[0], into * g->n[1]};
    int hit = -1;
    const double width = cast(f, k, x, d, least, &hit);
    if (hit < 0 || width < 1e-3 * least)
        return false;
    const struct thin_face *h = f->face + hit;
    if (g->n[0] * h->n[0] + g->n[1] * h->n[1] >= 0.0 || is_no_passage(f, g, h) ||
        is_corner(f, g, s, h, width))
        return false;
    const double beyond[2] = {x[0] + width * d[0], x[1] + width * d[1]};
    if (into > 0 && !(is_wetted(f, k, x, least) && is_wetted(f, hit, beyond, least)))
        return false;
    *t = (struct wall_thin){.at = {x[0] + 0.5 * width * d[0], x[1] + 0.5 * width * d[1]},
                            .width = width};
    if (f->passages && !leads_out(f, t->at, width))
        return false;
    char what[2][72];
    name_face(f->scene, g, what[0], sizeof what[0]);
    name_face(f->scene, h, what[1], sizeof what[1]);
    if (g->piece == h->piece)
        snprintf(t->what, sizeof t->what, "faces of %s", what[0]);
    else
        snprintf(t->what, sizeof t->what, "%s and %s", what[0], what[1]);
    return true;
}

/* The thinnest place that is so along a face for `stretch' at least. */
static bool find(const struct scene *c, int into, double least, double stretch, bool passages,
                 struct wall_thin *t)
{
    struct faces f = faces_of(c, into < 0);
    f.passages = passages;
    t->width = INFINITY;
    for (int k = 0; k < f.n; k++) {
        const int points = 1 + (int)(4.0 * f.face[k].length / least);
        double run = 0.0;
        for (int j = 0; j < points; j++) {
            const double step = f.face[k].length / points;
            struct wall_thin here;
            const bool is = is_thin(&f, k, (j + 0.5) * step, into, least, &here);
            run = is ? run + step : 0.0;
            if (is && run >= stretch && here.width < t->width)
                *t = here;
        }
    }
    mem_free(f.face);
    return isfinite(t->width);
}

bool wall_thin_solid(const struct scene *c, double least, struct wall_thin *t)
{
    return find(c, 1, least, 0.0, false, t);
}

bool wall_thin_gap(const struct scene *c, double least, struct wall_thin *t)
{
    return find(c, -1, least, 4.0 * least, false, t);
}

bool wall_thin_passage(const struct scene *c, double least, struct wall_thin *t)
{
    return find(c, -1, least, least / 6.0, true, t);
}
