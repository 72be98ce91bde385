/* body_backs.c - see body_backs.h. SPDX-License-Identifier: BSD-3-Clause */
#include "body_backs.h"

#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"

struct wall_ends {
    int n;
    double (*x)[2][2]; /* m: fluid on the left */
};

/* A piece without length has no direction and is left out. */
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

/* Walls of the case as segments: the sides that the particles' region reaches, and all lines. */
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

int body_backs_first_open(const struct scene *c, const struct sph_params *used, int n,
                          const double (*x)[2])
{
    const double *lo = c->domain.min, *hi = c->domain.max;
    struct wall_ends ends = ends_of(c, used);
    int inside = 0;
    while (inside < n && x[inside][0] > lo[0] && x[inside][1] > lo[1] && x[inside][0] < hi[0] &&
           x[inside][1] < hi[1])
        inside++;
    const int open = ends.n == 0 ? 0
                                 : wall_cover_first_open(ends.n, (const double(*)[2][2])ends.x, lo,
                                                         hi, 0.1 * used->dx, inside, x);
    mem_free(ends.x);
    return open;
}
