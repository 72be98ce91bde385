/* body_touch.c - corners of one polyline against another: contact in the plane is where a corner of
 * either comes nearer to the other than the gap. Pairs whose boxes are apart are left out first.
 * What a hinge holds is no contact. Called by body_contact.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "body_touch.h"

struct touch_box {
    double lo[2], hi[2];
};

/* By the beginnings of segments: outlines of bodies are closed, so these are all of their corners.
 */
static struct touch_box box_of(const struct walls *w, int first, int n, double more)
{
    struct touch_box b = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (int k = first; k < first + n; k++)
        for (int a = 0; a < 2; a++) {
            b.lo[a] = fmin(b.lo[a], w->segments[k].a[a] - more);
            b.hi[a] = fmax(b.hi[a], w->segments[k].a[a] + more);
        }
    return b;
}

/* Of a segment that stands off by shift. */
static bool meets(const struct touch_box *b, const struct segment *g, const double *shift)
{
    bool any = true;
    for (int a = 0; a < 2; a++)
        any = any && fmin(g->a[a], g->b[a]) + shift[a] <= b->hi[a] &&
              fmax(g->a[a], g->b[a]) + shift[a] >= b->lo[a];
    return any;
}

static bool holds(const struct touch_box *b, const double *x)
{
    return x[0] >= b->lo[0] && x[0] <= b->hi[0] && x[1] >= b->lo[1] && x[1] <= b->hi[1];
}

/* Segments of a body, or those at rest. The range of walls at rest is that of all segments, images
 * across periods included; a body's is its own segments alone, its images are among the last. */
static bool belongs(const struct segment *g, int body) { return g->body == body; }

static void range(const struct walls *w, int body, int *first, int *end)
{
    *first = body < 0 ? 0 : w->bodies[body].first;
    *end = body < 0 ? w->nsegments : *first + w->bodies[body].n;
}

/* Signed distance of x to what body, with its images or without, has within reach, its nearest
 * point and the normal there. */
static double nearest(const struct walls *w, int body, bool images, const double *x, double reach,
                      double *out)
{
    struct wall_side side = wall_side_none(reach);
    double least = INFINITY, foot[2] = {0.0, 0.0};
    const struct segment *found = NULL;
    int first, end;
    range(w, body, &first, &end);
    for (int k = first; k < (images ? w->nsegments : end); k++) {
        const struct segment *g = w->segments + k;
        if (!belongs(g, body))
            continue;
        const double along =
            fmax(0.0, fmin((x[0] - g->a[0]) * g->t[0] + (x[1] - g->a[1]) * g->t[1], g->length));
        const double p[2] = {g->a[0] + along * g->t[0], g->a[1] + along * g->t[1]};
        const double r = hypot(x[0] - p[0], x[1] - p[1]);
        if (r > reach)
            continue;
        wall_side_add(&side, g, x);
        if (r < least) {
            least = r;
            found = g;
            memcpy(foot, p, sizeof foot);
        }
    }
    if (!found)
        return INFINITY;
    const double d = side.distance;
    for (int a = 0; a < 2; a++)
        out[a] = fabs(d) > 1e-9 * reach ? (x[a] - foot[a]) / d : -found->n[a];
    out[2] = 0.0;
    return d;
}

double touch_distance(const struct walls *w, int dim, int body, const double *x, double reach,
                      double out[3])
{
    return dim == 2 ? nearest(w, body, true, x, reach, out)
                    : touch_distance3(w, body, x, reach, out);
}

/* Walls at rest do not move, even those with a velocity along themselves. */
static void velocity_of(const struct walls *w, int body, const double *x, double *u)
{
    u[0] = u[1] = u[2] = 0.0;
    if (body >= 0)
        body_velocity(w->bodies + body, x, u);
}

void pair_beside(const struct pair *p, const double *x, double y[3], int dim)
{
    for (int a = 0; a < dim; a++)
        y[a] = x[a] - p->shift[a];
}

void pair_add(const struct walls *w, struct pair *p, const struct touch *at)
{
    double other[3], beside[3] = {0.0, 0.0, 0.0};
    ROOM_IN(NULL, p->touch, p->n + 1);
    struct touch *t = p->touch + p->n++;
    *t = *at;
    t->of = 27 * at->of + p->image;
    memcpy(t->shift, p->shift, sizeof t->shift);
    pair_beside(p, t->x, beside, w->bodies[p->a].dim);
    velocity_of(w, t->mine ? p->a : p->b, t->mine ? t->x : beside, t->u);
    velocity_of(w, t->mine ? p->b : p->a, t->mine ? beside : t->x, other);
    vec3_add(t->u, -1.0, other);
}

/* What a joint holds cannot be pushed away from what it is fixed to. */
bool pair_is_held(const struct walls *w, const struct pair *p, const double *x, double gap)
{
    const int of[2] = {p->a, p->b};
    bool held = false;
    for (int e = 0; e < 2; e++) {
        const struct body *b = of[e] >= 0 ? w->bodies + of[e] : NULL;
        double arm[3] = {0.0, 0.0, 0.0};
        if (!b || !b->free || !b->free->hinged)
            continue;
        for (int a = 0; a < b->dim; a++)
            arm[a] = x[a] - (e ? p->shift[a] : 0.0) - b->free->hinge[a];
        vec3_add(arm, -vec3_dot(arm, b->free->axis), b->free->axis);
        held = held || vec3_length(arm) < gap;
    }
    return held;
}

double touch_settle(double d, const double way[3], double e, const double beside[3], double out[3])
{
    if (!isfinite(e) || vec3_dot(out, beside) > 0.9) /* the same face */
        return d;
    memcpy(out, beside, 3 * sizeof *out);
    return e - vec3_dot(way, out);
}

/* nearest, of corner x, beside what it may touch, of segment k of a line. Corners of lines at rest
 * have the normals of both segments in turn. */
static double nearest_of_corner(const struct walls *w, int of, int k, int against, const double *x,
                                double gap, double *out)
{
    const double d = nearest(w, against, false, x, 4.0 * gap, out);
    double way[3] = {0.0, 0.0, 0.0}, y[2], beside[3];
    int first, end;
    if (!(fabs(d) < TOUCH_FLUSH * gap))
        return d;
    range(w, of, &first, &end);
    const double *before = w->segments[k == first ? end - 1 : k - 1].n, *n = w->segments[k].n;
    for (int a = 0; a < 2; a++) {
        way[a] = TOUCH_FLUSH * gap * (n[a] + (of < 0 ? 0.0 : before[a]));
        y[a] = x[a] + way[a];
    }
    const double e = nearest(w, against, false, y, 4.0 * gap, beside);
    return touch_settle(d, way, e, beside, out);
}

/* Whether the line turns sharply at an end of segment k, as it does not along a disc. */
static bool is_sharp(const struct walls *w, int of, int k, int end)
{
    const double cosine = 0.866;
    int first, last;
    range(w, of, &first, &last);
    const int next = end ? (k == last - 1 ? first : k + 1) : k == first ? last - 1 : k - 1;
    const double *n = w->segments[k].n, *m = w->segments[next].n;
    return n[0] * m[0] + n[1] * m[1] < cosine;
}

/* Corners of one line that are nearer to the other than gap. */
static void find_corners(const struct walls *w, struct pair *p, const struct touch_box *near,
                         double gap, bool mine)
{
    const int of = mine ? p->a : p->b, against = mine ? p->b : p->a;
    int first, end;
    range(w, of, &first, &end);
    for (int k = first; k < end; k++) {
        const struct segment *g = w->segments + k;
        if (!belongs(g, of))
            continue;
        for (int e = 0; e < (of < 0 ? 2 : 1); e++) { /* lines at rest may be open */
            const double *own = e ? g->b : g->a;
            struct touch t = {.mine = mine, .corner = 2 * k + e, .sharp = is_sharp(w, of, k, e)};
            double y[2]; /* as x, beside b */
            for (int a = 0; a < 2; a++) {
                t.x[a] = own[a] + (mine ? 0.0 : p->shift[a]);
                y[a] = t.x[a] - p->shift[a];
            }
            const double d = holds(near, t.x)
                                 ? nearest_of_corner(w, of, k, against, mine ? y : t.x, gap, t.out)
                                 : INFINITY;
            t.depth = gap - d;
            if (d < gap && !pair_is_held(w, p, t.x, gap))
                pair_add(w, p, &t);
        }
    }
}

/* Whether anything of b comes near a's box. */
static bool any_near(const struct walls *w, const struct pair *p, const struct touch_box *near)
{
    int first, end;
    bool any = false;
    range(w, p->b, &first, &end);
    for (int k = first; k < end && !any; k++)
        any = belongs(w->segments + k, p->b) && meets(near, w->segments + k, p->shift);
    return any;
}

void pair_find2(const struct walls *w, struct pair *p, double gap)
{
    const struct touch_box everywhere = {{-INFINITY, -INFINITY}, {INFINITY, INFINITY}};
    const struct touch_box near = box_of(w, w->bodies[p->a].first, w->bodies[p->a].n, gap);
    if (!any_near(w, p, &near))
        return;
    find_corners(w, p, &everywhere, gap, true);
    find_corners(w, p, &near, gap, false);
}
