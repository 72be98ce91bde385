/* scene_cut.c - see scene_cut.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_cut.h"

#include <math.h>
#include <string.h>

/* A half plane: the side of the domain, m, on its axis, and which way it is outside. */
struct half {
    int axis;
    double at, out;
};

static double depth(const struct half *h, const double *x) { return h->out * (x[h->axis] - h->at); }

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
        const double part = a / (a - b);
        to->x[to->n][1 - h->axis] = x[1 - h->axis] + part * (y[1 - h->axis] - x[1 - h->axis]);
        to->x[to->n++][h->axis] = h->at;
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
