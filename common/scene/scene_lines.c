/* scene_lines.c - see scene_lines.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_lines.h"

#include "scene_fluid.h"
#include "scene_geometry.h"

static bool is_open(const struct scene_wall *w) { return w->points.n > 1 && !w->closed; }

/* Whether there is fluid of the shapes at x, within the domain. */
static bool wet(const struct scene *s, const struct exact *e, const double *x)
{
    for (int a = 0; a < 2; a++)
        if (x[a] <= s->domain.min[a] || x[a] >= s->domain.max[a])
            return false;
    return scene_is_fluid(s, e, x, NULL);
}

/* Shares of a line's length that have fluid close by on the left and on the right. */
static void sides_of(const struct scene *s, const struct line *l, double share[2])
{
    const struct exact e = exact_create(s);
    const double whole = line_length(l), off = 1e-4 * line_size(l);
    enum { PLACES = 400 };
    share[0] = share[1] = 0.0;
    for (int k = 0; k < line_segments(l); k++) {
        const double *a = l->x[k], *b = l->x[(k + 1) % l->n];
        const double d[2] = {b[0] - a[0], b[1] - a[1]}, length = hypot(d[0], d[1]);
        const int n = 1 + (int)(PLACES * length / whole);
        for (int i = 0; i < n && length > 0.0; i++)
            for (int right = 0; right < 2; right++) {
                const double f = (i + 0.5) / n, h = (right ? -off : off) / length;
                const double x[3] = {a[0] + f * d[0] - h * d[1], a[1] + f * d[1] + h * d[0], 0.0};
                share[right] += wet(s, &e, x) ? length / n / whole : 0.0;
            }
    }
}

/* Whether walls stand around wall k: sides of the domain, or a larger closed line. */
static bool is_enclosed(const struct scene *s, int k)
{
    const struct line l = line_of(&s->walls[k].points, true);
    bool any = false;
    for (int m = 0; m < s->nwalls; m++) {
        const struct scene_wall *w = s->walls + m;
        const struct line o = line_of(&w->points, true);
        any = any || (w->side != SIDE_NONE && w->kind < WALL_INFLOW) ||
              (m != k && w->closed && line_inside(&o, l.x[0]) &&
               fabs(line_area(&o)) > fabs(line_area(&l)));
    }
    return any;
}

/* The sides of the domain on which, or beyond which, x lies, as bits. */
static int sides_at(const struct scene *s, const double *x)
{
    int at = 0;
    for (int side = 0; side < 4; side++) {
        const double *lo = s->domain.min, *hi = s->domain.max, near = hi[side / 2] - lo[side / 2];
        const double in = side % 2 ? hi[side / 2] - x[side / 2] : x[side / 2] - lo[side / 2];
        at |= in < 1e-6 * near ? 1 << side : 0;
    }
    return at;
}

/* The last of the sides that both ends of a line share; -1: none. */
static int side_of_ends(const struct scene *s, const struct line *l)
{
    const int at = sides_at(s, l->x[0]) & sides_at(s, l->x[l->n - 1]);
    int side = -1;
    for (int k = 0; k < 4; k++)
        side = at >> k & 1 ? k : side;
    return side;
}

/* The water of the shapes inside the closed line of these points over all of it; none: 0. */
static double share_held(const struct scene *s, const struct param_points *points)
{
    enum { ACROSS = 200 };
    const struct exact e = exact_create(s);
    const struct line l = line_of(points, true);
    const double *lo = s->domain.min, *hi = s->domain.max;
    int n[2] = {0, 0};
    for (int i = 0; i < ACROSS * ACROSS; i++) {
        const double x[3] = {lo[0] + (i % ACROSS + 0.5) / ACROSS * (hi[0] - lo[0]),
                             lo[1] + (i / ACROSS + 0.5) / ACROSS * (hi[1] - lo[1]), 0.0};
        if (wet(s, &e, x))
            n[line_inside(&l, x)]++;
    }
    return (double)n[1] / fmax(1.0, n[0] + n[1]);
}

/* All water inside and no other walls: then its points are walls of the water, not a solid in it.
 */
bool scene_body_is_tank(const struct scene *s, int k)
{
    const struct param_points *points = &s->bodies[k].points;
    return s->domain.dim == 2 && s->nshapes > 0 && s->nwalls == 0 &&
           s->initial.field == FIELD_REST && points->n > 2 && share_held(s, points) == 1.0;
}

/* How far the side's outward normal points down, -1 to 1. */
static double downward(const struct scene *s, int side)
{
    double g[3];
    const double size = scene_still_gravity(s, g);
    return size > 0.0 ? g[side / 2] / size * (side % 2 ? 1.0 : -1.0) : 0.0;
}

/* An open line with water on both sides that hangs from a side of the domain, between other walls,
 * is a baffle and not the only tank: what is inside it is solid. On the floor, where it is a roof
 * over what it would hold, it is a dyke as long as most of the water is around it. both: its right
 * has half as much water as its left, or more. */
static bool is_baffle_inside_out(const struct scene *s, int k, bool both)
{
    const struct line open = line_of(&s->walls[k].points, false);
    const struct line shut = line_of(&s->walls[k].points, true);
    const int side = side_of_ends(s, &open);
    if (open.n < 3 || !(line_area(&shut) > 0.0) || side < 0 || !is_enclosed(s, k))
        return false;
    const bool stands = downward(s, side) > 0.0 && both;
    return share_held(s, &s->walls[k].points) <
           (stands ? 0.5 : 1.0 / 11.0); /* a tenth of what is around it */
}

/* Whether line k, which spans the domain, may be a lid: another open line is below it, or the water
 * reaches the domain's end above it. */
static bool may_be_lid(const struct scene *s, int k)
{
    const struct exact e = exact_create(s);
    const struct line l = line_of(&s->walls[k].points, false);
    const double middle[3] = {0.5 * (l.x[0][0] + l.x[l.n - 1][0]),
                              0.5 * (l.x[0][1] + l.x[l.n - 1][1]), 0.0};
    const int up = scene_still_axis(s);
    double top[3] = {middle[0], middle[1], 0.0};
    top[up] = s->fluid.gravity[up] < 0.0
                  ? s->domain.max[up] - 1e-6 * (s->domain.max[up] - s->domain.min[up])
                  : s->domain.min[up] + 1e-6 * (s->domain.max[up] - s->domain.min[up]);
    bool below = false;
    for (int m = 0; m < s->nwalls; m++) {
        const struct param_points *o = &s->walls[m].points;
        below = below || (m != k && is_open(s->walls + m) &&
                          scene_height(s, (double[]){o->x[0][0], o->x[0][1], 0.0}) <
                              scene_height(s, middle));
    }
    return below || wet(s, &e, top);
}

/* An open line with water on both sides that goes from one side of the domain to another is the bed
 * of what is above it, as a beach is, unless it cuts off a corner at the top, whose ceiling it is,
 * or spans the domain and may be a lid. Between floor and ceiling the sense of its points decides.
 */
static bool is_bed_inside_out(const struct scene *s, int k)
{
    const struct line l = line_of(&s->walls[k].points, false);
    const double *a = l.x[0], *b = l.x[l.n - 1];
    const int at[2] = {sides_at(s, a), sides_at(s, b)};
    double g[3], down = 0.0;
    const double size = scene_still_gravity(s, g);
    if (size == 0.0 || !at[0] || !at[1] || at[0] & at[1])
        return false;
    for (int side = 0; side < 4; side++)
        down += ((at[0] >> side & 1) + (at[1] >> side & 1)) * downward(s, side);
    const double up = ((b[1] - a[1]) * g[0] - (b[0] - a[0]) * g[1]) / size; /* of its left */
    if (fabs(up) < 0.1 * hypot(b[0] - a[0], b[1] - a[1]))
        return false;
    return down < -0.5 ? up > 0.0 : up < 0.0 && (down > 0.5 || !may_be_lid(s, k));
}

/* An open line is turned when hardly half as much of it has fluid on its left as on its right:
 * those of an island between two waters, or of a fillet in a corner, are equal or nearly so; or
 * when it is a bed that would have the water below itself, or a baffle with it inside. A closed one
 * may be a tank in which the shapes let water go on through its walls, or an island: it is turned
 * if all fluid is on its right, or if it is a tank by its sense, with water around, inside other
 * walls: an island. */
bool scene_line_is_reversed(const struct scene *s, int k)
{
    const struct scene_wall *w = s->walls + k;
    const struct line l = line_of(&w->points, w->closed);
    double share[2];
    sides_of(s, &l, share);
    const bool both = share[1] > 0.5 * share[0];
    if (!w->closed)
        return share[0] < 0.5 * share[1] || (both && is_bed_inside_out(s, k)) ||
               is_baffle_inside_out(s, k, both);
    if (share[0] > 0.01 && share[1] > 0.01)
        return line_area(&l) > 0.0 && is_enclosed(s, k);
    return share[0] < share[1];
}

bool scene_has_open_lines(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < s->nwalls; k++)
        any = any || is_open(s->walls + k);
    return any;
}

/* Where lines are equally near, as in a corner, it is the one that x is further off sideways. */
bool scene_is_behind_lines(const struct scene *s, const double *x)
{
    double least = INFINITY, aside = 0.0;
    for (int k = 0; k < s->nwalls; k++) {
        const struct line l = line_of(&s->walls[k].points, false);
        if (!is_open(s->walls + k))
            continue;
        const struct line_foot f = line_foot(&l, x);
        const double same = 1e-9 * least;
        if (f.distance > least + same ||
            (f.distance > least - same && fabs(f.aside) <= fabs(aside)))
            continue;
        least = f.distance;
        aside = f.past && !sides_at(s, l.x[f.past < 0 ? 0 : l.n - 1]) ? 0.0 : f.aside;
    }
    return aside < 0.0;
}
