/* body_backs.c - see body_backs.h. SPDX-License-Identifier: BSD-3-Clause */
#include "body_backs.h"

#include <string.h>

#include "../../common/base/mem.h"
#include "../particles/params_derived.h"
#include "../walls/wall_cover.h"

struct wall_ends {
    int n;
    double (*x)[2][2]; /* m: fluid on the left */
};

static void add(struct wall_ends *to, const double *a, const double *b)
{
    if (to->n % 64 == 0)
        GROW(to->x, to->n, to->n + 64);
    if (a[0] == b[0] && a[1] == b[1])
        return;
    memcpy(to->x[to->n][0], a, sizeof to->x[0][0]);
    memcpy(to->x[to->n++][1], b, sizeof to->x[0][1]);
}

static void add_side(struct wall_ends *to, const struct scene_domain *d, int side)
{
    static const int start[] = {3, 1, 0, 2}; /* x_min, x_max, y_min, y_max */
    const double *lo = d->min, *hi = d->max;
    const double corner[4][2] = {{lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}};
    add(to, corner[start[side]], corner[(start[side] + 1) % 4]);
}

static struct wall_ends ends_of(const struct scene *c, const struct sph_params *used)
{
    struct wall_ends to = {0};
    for (int k = 0; k < c->nwalls; k++) {
        const struct scene_wall *w = c->walls + k;
        const int side = w->side - SIDE_X_MIN, n = w->points.n;
        if (w->kind > WALL_NO_SLIP)
            continue;
        if (side >= 0 && side < 4 && sph_params_reaches(&c->domain, used, side))
            add_side(&to, &c->domain, side);
        for (int i = 0; side < 0 && i < (w->closed ? n : n - 1); i++)
            add(&to, w->points.x[i], w->points.x[(i + 1) % n]);
    }
    return to;
}

static bool is_shut(const struct scene *c, const struct wall_ends *ends, double near,
                    const double *x)
{
    const double *lo = c->domain.min, *hi = c->domain.max;
    return x[0] > lo[0] && x[1] > lo[1] && x[0] < hi[0] && x[1] < hi[1] &&
           wall_cover_shuts(ends->n, (const double(*)[2][2])ends->x, lo, hi, near, x);
}

bool body_backs_shut_in(const struct scene *c, const struct sph_params *used, int k)
{
    const struct param_points *of = &c->bodies[k].points;
    struct wall_ends ends = ends_of(c, used);
    bool shut = of->n > 0 && ends.n > 0;
    for (int i = 0; i < of->n && shut; i++)
        shut = is_shut(c, &ends, 0.1 * used->dx, of->x[i]);
    mem_free(ends.x);
    return shut;
}

bool body_backs_hold(const struct scene *c, const struct sph_params *used, const double *x)
{
    struct wall_ends ends = ends_of(c, used);
    const bool shut = ends.n > 0 && is_shut(c, &ends, 0.1 * used->dx, x);
    mem_free(ends.x);
    return shut;
}
