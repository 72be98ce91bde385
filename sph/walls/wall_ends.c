/* wall_ends.c - see wall_ends.h. An end of a line is free if it lies inside the domain, off all
 * sides, bodies and other walls, and its own line does not come back to it; it is told where water
 * stands beyond it, or where the other end of the line stands on a wall. Of the case alone, before
 * particles exist.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wall_ends.h"

/* Ends of segment k of a wall: of its points, or of the side of the domain that it is. */
static bool segment_of(const struct scene *c, const struct scene_wall *w, int k, double a[2],
                       double b[2])
{
    if (w->kind > WALL_NO_SLIP)
        return false;
    if (w->side == SIDE_NONE) {
        const int n = w->points.n;
        if (k >= (w->closed ? n : n - 1))
            return false;
        for (int d = 0; d < 2; d++) {
            a[d] = w->points.x[k][d];
            b[d] = w->points.x[(k + 1) % n][d];
        }
        return true;
    }
    const int axis = (w->side - SIDE_X_MIN) / 2, high = (w->side - SIDE_X_MIN) % 2;
    if (k > 0)
        return false;
    for (int d = 0; d < 2; d++) {
        a[d] = d == axis && high ? c->domain.max[d] : c->domain.min[d];
        b[d] = d == axis && !high ? c->domain.min[d] : c->domain.max[d];
    }
    return true;
}

/* Whether x lies within near of the segment, and of its inner part where that is asked for. */
static bool is_on(const double *x, const double *a, const double *b, double near, bool inner)
{
    const double d[2] = {b[0] - a[0], b[1] - a[1]}, e[2] = {x[0] - a[0], x[1] - a[1]};
    const double length = hypot(d[0], d[1]);
    const double at = (e[0] * d[0] + e[1] * d[1]) / length;
    const double rim = inner ? -near : near;
    return fabs(e[0] * d[1] - e[1] * d[0]) < near * length && at > -rim && at < length + rim;
}

/* Whether another wall runs past x, as wall k's end or anywhere. */
static bool meets(const struct scene *c, int k, const double *x, double near, bool inner)
{
    double a[2], b[2];
    for (int j = 0; j < c->nwalls; j++)
        for (int i = 0; j != k && segment_of(c, c->walls + j, i, a, b); i++)
            if (is_on(x, a, b, near, inner))
                return true;
    return false;
}

/* Whether x is inside the domain, off its sides and all bodies. */
static bool is_free(const struct scene *c, int k, const double *x, double near)
{
    for (int d = 0; d < 2; d++)
        if (x[d] < c->domain.min[d] + near || x[d] > c->domain.max[d] - near)
            return false;
    for (int j = 0; j < c->nbodies; j++)
        for (int i = 0; i < c->bodies[j].points.n; i++)
            if (is_on(x, c->bodies[j].points.x[i],
                      c->bodies[j].points.x[(i + 1) % c->bodies[j].points.n], near, false))
                return false;
    return !meets(c, k, x, near, false);
}

/* Whether the line goes on from its own end x elsewhere, as one that is closed by hand. */
static bool comes_back(const struct scene_wall *w, int end, const double *x, double near)
{
    const int n = w->points.n;
    for (int i = end ? 0 : 1; i + 1 < n - (end ? 1 : 0); i++)
        if (is_on(x, w->points.x[i], w->points.x[i + 1], near, false))
            return true;
    return false;
}

/* Whether there is water at the start beyond the end x of a line that comes from `from'. */
static bool is_wet(const struct scene *c, const double *x, const double *from, double dx)
{
    const struct exact e = exact_create(c);
    const double way = atan2(x[1] - from[1], x[0] - from[0]);
    bool wet = false;
    for (int k = -2; k <= 2; k++) {
        const double angle = way + k * 0.5, r = 0.75 * dx;
        const double y[3] = {x[0] + r * cos(angle), x[1] + r * sin(angle), 0.0};
        wet = wet || (scene_is_fluid(c, &e, y, NULL) && scene_is_room(c, y));
    }
    return wet;
}

bool wall_ends_open(const struct scene *c, double dx, struct wall_end *e)
{
    const double near = 0.1 * dx;
    for (int k = 0; k < c->nwalls; k++) {
        const struct scene_wall *w = c->walls + k;
        const int last = w->points.n - 1;
        if (w->side != SIDE_NONE || w->closed || last < 1)
            continue;
        for (int end = 0; end < 2; end++) {
            const double *x = w->points.x[end ? last : 0], *foot = w->points.x[end ? 0 : last];
            const double *before = w->points.x[end ? last - 1 : 1];
            if (!is_free(c, k, x, near) || comes_back(w, end, x, near))
                continue;
            *e = (struct wall_end){k, {x[0], x[1]}, meets(c, k, foot, near, true)};
            if (e->stands || is_wet(c, x, before, dx))
                return true;
        }
    }
    return false;
}
