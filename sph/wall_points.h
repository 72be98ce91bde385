/* wall_points.h - quadrature of a wall segment within a particle's support: Gauss's rule of four
 * points on each piece between the ends, the rim of the support and the foot of the particle.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_POINTS_H
#define SPH_WALL_POINTS_H

#include "kernel.h"
#include "walls.h"

enum { WALL_POINTS = 8 };

struct wall_point {
    double x[2], weight, W; /* m, m, 1/m^2: kernel of radius R there */
};

/* Points of the segment within R of x; returns their number. foot: whether the foot of x lies on
 * the segment. */
static inline int wall_points_foot(const struct segment *g, const double *x, double R,
                                   struct wall_point at[WALL_POINTS], bool *foot)
{
    static const double z[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                0.8611363115940526};
    static const double weight[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                     0.3478548451374538};
    const double d[2] = {g->a[0] - x[0], g->a[1] - x[1]};
    const double height = g->n[0] * d[0] + g->n[1] * d[1], from = g->t[0] * d[0] + g->t[1] * d[1];
    const double half2 = R * R - height * height, to = from + g->length;
    int n = 0;
    *foot = from <= 0.0 && to >= 0.0;
    if (half2 <= 0.0)
        return 0;
    const double half = sqrt(half2), lo = fmax(from, -half), hi = fmin(to, half);
    if (hi <= lo)
        return 0;
    const bool split = lo < 0.0 && hi > 0.0;
    for (int piece = 0; piece < (split ? 2 : 1); piece++) {
        const double p = piece == 1 ? 0.0 : lo, q = split && piece == 0 ? 0.0 : hi;
        for (int k = 0; k < 4; k++) {
            const double y = 0.5 * (p + q) + 0.5 * (q - p) * z[k];
            for (int a = 0; a < 2; a++)
                at[n].x[a] = x[a] + height * g->n[a] + y * g->t[a];
            at[n].weight = 0.5 * (q - p) * weight[k];
            at[n++].W = kernel_w(2, sqrt(height * height + y * y), R);
        }
    }
    return n;
}

static inline int wall_points(const struct segment *g, const double *x, double R,
                              struct wall_point at[WALL_POINTS])
{
    bool foot;
    return wall_points_foot(g, x, R, at, &foot);
}

#endif
