/* scene_cut.c - see scene_cut.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_cut.h"

#include <math.h>
#include <string.h>

#include "scene_geometry.h"

/* A half plane: the side of the domain, m, on its axis, and which way it is outside. */
struct half {
    int axis;
    double at, out;
};

static double depth(const struct half *h, const double *x) { return h->out * (x[h->axis] - h->at); }

/* Where the way from x to y crosses. */
static void cross(const struct half *h, const double *x, const double *y, double *to)
{
    const int along = 1 - h->axis;
    const double part = depth(h, x) / (depth(h, x) - depth(h, y));
    to[along] = x[along] + part * (y[along] - x[along]);
    to[h->axis] = h->at;
}

/* Corners inside, and where edges cross (Sutherland & Hodgman, Commun. ACM 17, 1974). Returns
 * whether they are a polygon, cut in one piece. */
static bool keep_inside(const struct half *h, double near, const struct param_points *from,
                        struct param_points *to)
{
    int crossings = 0;
    to->n = 0;
    for (int i = 0; i < from->n; i++) {
        const double *x = from->x[i], *y = from->x[(i + 1) % from->n];
        const double a = depth(h, x), b = depth(h, y);
        const bool crosses = (a > near) != (b > near);
        if (to->n + 2 > PARAM_POINTS_MAX)
            return false;
        if (a <= near) {
            memcpy(to->x[to->n], x, sizeof to->x[0]);
            to->x[to->n++][h->axis] = a > -near ? h->at : x[h->axis];
        }
        crossings += crosses;
        if (!crosses || fabs(a) <= near || fabs(b) <= near)
            continue;
        cross(h, x, y, to->x[to->n++]);
    }
    return crossings == 2 && to->n >= 3;
}

void scene_cut_at_sides(const struct scene *s, struct scene_body *b)
{
    struct param_points kept;
    for (int side = SIDE_X_MIN; side < SIDE_X_MIN + 4; side++) {
        const int a = (side - SIDE_X_MIN) / 2;
        const bool high = (side - SIDE_X_MIN) % 2;
        const struct scene_wall *w = scene_wall_of(s, (enum scene_side)side);
        const struct half h = {a, high ? s->domain.max[a] : s->domain.min[a], high ? 1.0 : -1.0};
        const double near = 1e-9 * (s->domain.max[a] - s->domain.min[a]);
        if (s->domain.dim > 2 || !w || w->kind >= WALL_INFLOW || scene_body_moves(b) ||
            !keep_inside(&h, near, &b->points, &kept))
            continue;
        b->points = kept;
        b->cut = true;
    }
}

/* Leaves out the end of an open line that is outside: its last points. */
static void cut_end(const struct half *h, struct param_points *p)
{
    while (p->n > 2 && depth(h, p->x[p->n - 2]) >= 0.0)
        p->n--;
    if (depth(h, p->x[p->n - 1]) > 0.0 && depth(h, p->x[p->n - 2]) < 0.0)
        cross(h, p->x[p->n - 2], p->x[p->n - 1], p->x[p->n - 1]);
}

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
            cut_end(&(struct half){a, high ? *hi : *lo, high ? 1.0 : -1.0}, &kept);
            points_reverse(&kept);
        }
        bool is_inside = true;
        for (int k = 0; k < kept.n; k++)
            is_inside = is_inside && kept.x[k][a] >= *lo - near && kept.x[k][a] <= *hi + near;
        if (is_inside)
            w->points = kept;
    }
}
