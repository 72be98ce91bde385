/* scene_cut.c - see scene_cut.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_cut.h"

#include "scene_geometry.h"

/* Where an outline crosses a wall: between its corner i and the next, in a segment of the wall. */
struct crossing {
    int corner, segment;
    double x[2]; /* m */
};

/* How far x lies on the right of the segment from a to b, m, where no fluid is. */
static double behind(const double *a, const double *b, const double *x)
{
    const double d[2] = {b[0] - a[0], b[1] - a[1]};
    return (d[1] * (x[0] - a[0]) - d[0] * (x[1] - a[1])) / hypot(d[0], d[1]);
}

/* Place between x and y, of which the one is p, the other q behind a wall, that is on it. */
static void meet(const double *x, double p, const double *y, double q, double *at)
{
    for (int a = 0; a < 2; a++)
        at[a] = x[a] + p / (p - q) * (y[a] - x[a]);
}

/* Where the body goes behind the wall (0) and comes back (1); whether it does so once. A corner
 * nearer than `near', m, is on the wall, and so before it. */
static bool find_crossings(const struct line *wall, double near, const struct param_points *p,
                           struct crossing found[2])
{
    int n[2] = {0, 0};
    for (int i = 0; i < p->n * (wall->n - 1); i++) {
        struct crossing c = {.corner = i % p->n, .segment = i / p->n};
        const double *x = p->x[c.corner], *y = p->x[(c.corner + 1) % p->n];
        const double *a = wall->x[c.segment], *b = wall->x[c.segment + 1];
        const double from = behind(a, b, x), to = behind(a, b, y);
        if ((from > near) == (to > near))
            continue;
        meet(x, from, y, to, c.x);
        if (fabs(from) <= near || fabs(to) <= near)
            memcpy(c.x, fabs(from) <= near ? x : y, sizeof c.x);
        const double d[2] = {b[0] - a[0], b[1] - a[1]};
        const double along = d[0] * (c.x[0] - a[0]) + d[1] * (c.x[1] - a[1]);
        if (along < 0.0 || along >= d[0] * d[0] + d[1] * d[1])
            continue;
        const int back = from > near;
        found[back] = c;
        n[back]++;
    }
    return n[0] == 1 && n[1] == 1;
}

/* Corners that coincide with the one before are left out: a piece without length has no direction.
 */
static void add_corner(struct param_points *to, const double *x, double near)
{
    const double *last = to->x[to->n > 0 ? to->n - 1 : 0];
    if (to->n > 0 && hypot(x[0] - last[0], x[1] - last[1]) <= near)
        return;
    memcpy(to->x[to->n++], x, sizeof to->x[0]);
}

/* Whether the outline, on its way from its corner x, goes behind before it comes back. */
static bool is_first(const double *x, const struct crossing c[2])
{
    return hypot(c[0].x[0] - x[0], c[0].x[1] - x[1]) < hypot(c[1].x[0] - x[0], c[1].x[1] - x[1]);
}

/* What of an outline is before a wall that cuts it once: its corners there, then the way back along
 * the wall. Whether it does, and some is left. */
static bool keep_before(const struct line *wall, double near, const struct param_points *p,
                        struct param_points *to)
{
    struct crossing c[2];
    if (wall->n + p->n + 2 > PARAM_POINTS_MAX || !find_crossings(wall, near, p, c))
        return false;
    to->n = 0;
    add_corner(to, c[1].x, near);
    int before = (c[0].corner - c[1].corner + p->n) % p->n;
    if (before == 0 && is_first(p->x[c[0].corner], c)) /* a kink of the wall in one edge */
        before = p->n;
    for (int k = 1; k <= before; k++)
        add_corner(to, p->x[(c[1].corner + k) % p->n], near);
    add_corner(to, c[0].x, near);
    for (int k = c[0].segment; k < c[1].segment; k++)
        add_corner(to, wall->x[k + 1], near);
    for (int k = c[0].segment; k > c[1].segment; k--)
        add_corner(to, wall->x[k], near);
    return to->n >= 3;
}

/* Bodies that a wall cuts several times are left as they are. */
static void cut_at(const struct line *wall, double near, struct scene_body *b)
{
    struct param_points kept;
    if (!keep_before(wall, near, &b->points, &kept))
        return;
    b->points = kept;
    b->cut = true;
}

/* A closed side in the plane: the axis across it, where it is, m, and its sense along the other
 * axis with the fluid on its left. */
struct cut_side {
    int axis;
    double at, sense;
};

static struct cut_side side_of(const struct scene_domain *d, int side)
{
    const int a = side / 2;
    const bool high = side % 2;
    return (struct cut_side){a, high ? d->max[a] : d->min[a], (a == 1) != high ? 1.0 : -1.0};
}

/* Where a line ends at x on a closed side, the wall goes on along that, as the floor does at the
 * toe of a bed. Sets y, far beyond x (way 1) or before it (-1). */
static bool goes_on(const struct scene *s, const double *x, double way, double near, double y[2])
{
    const struct scene_domain *d = &s->domain;
    for (int side = 0; side < 4; side++) {
        const struct cut_side is = side_of(d, side);
        const int b = 1 - is.axis;
        const double along = way * is.sense;
        if (!scene_side_is_wall(s, SIDE_X_MIN + side) || fabs(x[is.axis] - is.at) > near ||
            !(along > 0.0 ? x[b] < d->max[b] - near : x[b] > d->min[b] + near))
            continue;
        y[is.axis] = is.at;
        y[b] = x[b] + 2.0 * along * (d->max[b] - d->min[b]);
        return true;
    }
    return false;
}

/* By an open line, with the sides that it ends on. */
static void cut_at_line(const struct scene *s, const struct line *l, struct scene_body *b)
{
    const double near = 1e-9 * line_size(l);
    double(*x)[2] = (double(*)[2])mem_new((size_t)l->n + 2, sizeof *x);
    int n = goes_on(s, l->x[0], -1.0, near, x[0]);
    memcpy(x + n, l->x, (size_t)l->n * sizeof *x);
    n += l->n;
    n += goes_on(s, l->x[l->n - 1], 1.0, near, x[n]);
    cut_at(&(struct line){n, (const double(*)[2])x, false}, near, b);
    mem_free(x);
}

void scene_cut_at_walls(const struct scene *s, struct scene_body *b)
{
    const struct scene_domain *d = &s->domain;
    if (d->dim > 2 || scene_body_moves(b) || b->points.n < 3)
        return;
    for (int k = 0; k < s->nwalls; k++) {
        const struct line l = line_of(&s->walls[k].points, false);
        if (l.n > 1 && !s->walls[k].closed)
            cut_at_line(s, &l, b);
    }
    for (int side = 0; side < 4; side++) {
        const struct cut_side is = side_of(d, side);
        const int a = is.axis;
        const double L = d->max[1 - a] - d->min[1 - a];
        double x[2][2];
        x[0][a] = x[1][a] = is.at;
        x[is.sense < 0.0][1 - a] = d->min[1 - a] - L;
        x[is.sense > 0.0][1 - a] = d->max[1 - a] + L;
        if (scene_side_is_wall(s, SIDE_X_MIN + side))
            cut_at(&(struct line){2, (const double(*)[2])x, false}, 1e-9 * (d->max[a] - d->min[a]),
                   b);
    }
}

/* In 3D at sides alone. */
bool scene_cut_mesh(const struct scene *s, const struct scene_body *b, struct trimesh *m)
{
    const struct scene_domain *d = &s->domain;
    bool any = false;
    for (int side = 0; side < 6 && !scene_body_moves(b); side++) {
        const int a = side / 2;
        if (scene_side_is_wall(s, SIDE_X_MIN + side))
            any |= trimesh_end(m, a, side % 2 ? d->max[a] : d->min[a], side % 2,
                               1e-6 * (d->max[a] - d->min[a]));
    }
    return any;
}

/* Leaves out the end of an open line that is outside: its last points. */
static void cut_end(int axis, double at, double out, struct param_points *p)
{
#define DEPTH(k) (out * (p->x[p->n - (k)][axis] - at))
    while (p->n > 2 && DEPTH(2) >= 0.0)
        p->n--;
    if (DEPTH(1) <= 0.0 || DEPTH(2) >= 0.0)
        return;
    meet(p->x[p->n - 1], DEPTH(1), p->x[p->n - 2], DEPTH(2), p->x[p->n - 1]);
    p->x[p->n - 1][axis] = at;
#undef DEPTH
}

/* A line that spans the period keeps what lies within it; one that ends inside is drawn so on
 * purpose. */
void scene_cut_at_periods(const struct scene *s, struct scene_wall *w)
{
    for (int a = 0; a < 2 && s->domain.dim == 2 && !w->closed; a++) {
        struct param_points kept = w->points;
        const double *lo = s->domain.min + a, *hi = s->domain.max + a, near = 1e-9 * (*hi - *lo);
        const double first = kept.x[0][a], last = kept.x[kept.n - 1][a];
        if (!s->domain.periodic[a] || fmin(first, last) > *lo + near ||
            fmax(first, last) < *hi - near)
            continue;
        for (int end = 0; end < 2; end++) {
            const bool high = (first < last) != (end == 1);
            cut_end(a, high ? *hi : *lo, high ? 1.0 : -1.0, &kept);
            points_reverse(&kept);
        }
        bool is_inside = true;
        for (int k = 0; k < kept.n; k++)
            is_inside = is_inside && kept.x[k][a] >= *lo - near && kept.x[k][a] <= *hi + near;
        if (is_inside)
            w->points = kept;
    }
}
