/* wall_air.h - what normal flux walls do to drops and films of one particle, which have air around
 * them: a drop falls freely until it lands, and hangs from no roof.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_AIR_H
#define SPH_WALL_AIR_H

#include "../sph.h"
#include "wall_list.h"

/* Whether there are too few neighbours for gradients: none are made then. */
static inline bool wall_air_around(const struct sph *s, const double *slope, const int dim)
{
    bool none = s->surface != NULL;
    for (int a = 0; a < dim + dim * dim && none; a++)
        none = slope[a] == 0.0;
    return none;
}

/* 1 before walls of one side and in right corners of two or three, 0 in a gap: there a layer one
 * particle thick has no air beside it. */
static inline double wall_air_open(const struct wall_list *l, int k, const int dim)
{
    double all = 0.0, along[3] = {0.0}, square = 0.0;
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        all += t->is.W;
        for (int a = 0; a < dim; a++)
            along[a] += t->is.W * t->n[a];
    }
    for (int a = 0; a < dim; a++)
        square += along[a] * along[a];
    return all > 0.0 ? fmin(1.0, fmax(0.0, 2.5 * sqrt(square) / all - 0.4)) : 1.0;
}

/* Of the weight of a piece, what stops a layer one particle thick, or less, before it. The kernel
 * would stop it from R on, and it hung there, 2.3 dx over a floor, by the pressure of its own
 * volume; so it falls freely down to dx, and from dx/2 on, where a row rests, the wall is whole.
 * The end is smooth: one at dx/2 alone throws a drop up again. */
static inline double wall_air_share(const struct sph *s, const struct wall_touch *t, double open)
{
    const double q = fmax(0.0, fmin(2.0 * t->height / s->dx - 1.0, 1.0));
    return 1.0 - open * q * q * (3.0 - 2.0 * q);
}

/* Whether a film runs along a wall so fast that its weight is nothing to it: rho u^2/2 above
 * WEIGHTS layers of particles. What hangs or drips is slower; a jet of one particle that no wall
 * held would leave a plate that follows it, and be hit again with rho c u. */
static inline bool wall_air_runs_along(const struct sph *s, const double *u, const double *uw,
                                       const double *n, int dim)
{
    enum { WEIGHTS = 500 };
    double square = 0.0, across = 0.0, gravity = 0.0;
    for (int a = 0; a < dim; a++) {
        square += (u[a] - uw[a]) * (u[a] - uw[a]);
        across += (u[a] - uw[a]) * n[a];
        gravity += s->gravity[a] * s->gravity[a];
    }
    return fmax(square - across * across, 0.0) >= 2.0 * WEIGHTS * sqrt(gravity) * s->dx;
}

#endif
