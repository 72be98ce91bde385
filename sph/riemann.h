/* riemann.h - states of a pair and their Riemann problem, four pairs at once.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_RIEMANN_H
#define SPH_RIEMANN_H

#include "sph.h"
#include "vec.h"

/* What is added to phi_i on the way to the middle of the pair: D = phi_j - phi_i, s = grad
 * phi_i.(x_j - x_i); to phi_j it is subtracted, with j's gradient. b = 2 s - D is the difference on
 * the far side. minmod [2.83]   D/2 clipped to 0 .. s/2 koren           (b + 2 D)/6, the
 * third-order value, within 0 .. min(b, D) none            s/2 All are D/2 on a linear field, which
 * makes both states equal there. */
static inline __attribute__((always_inline)) vec half_step(vec D, vec s, const int limiter)
{
    const vec zero = {0.0, 0.0, 0.0, 0.0};
    if (limiter == LIMITER_NONE)
        return 0.5 * s;
    const mask negative = D < zero;
    const vec size = vec_pick(negative, -D, D);
    if (limiter == LIMITER_MINMOD) {
        const vec along = vec_pick(negative, -s, s);
        const vec m = 0.5 * vec_max(vec_min(along, size), zero);
        return vec_pick(negative, -m, m);
    }
    const vec b = 2.0 * s - D, along = vec_pick(negative, -b, b);
    const vec third = (along + 2.0 * size) * (1.0 / 6.0);
    const vec m = vec_max(vec_min(vec_min(along, third), size), zero);
    return vec_pick(negative, -m, m);
}

/* P and c of Tait's equation with gamma 7, by products; r = rho/rho0. */
static inline __attribute__((always_inline)) void tait7(vec r, double B, double c0, vec *p, vec *c)
{
    const vec r2 = r * r, r3 = r2 * r;
    *p = B * (r2 * r2 * r3 - 1.0);
    *c = c0 * r3;
}

/* Linearised Riemann problem [2.100]: states l, r with Z = rho c, velocities along the line of
 * centres, inverse = 1/(Zl + Zr). Low dissipation (Zhang, Hu & Adams, J. Comput. Phys. 335, 2017):
 * in P only, the jump of velocity counts by min(1, 3 max(ul - ur, 0)/c0). */
static inline __attribute__((always_inline)) void riemann(vec Zl, vec ul, vec Pl, vec Zr, vec ur,
                                                          vec Pr, vec inverse, const bool low,
                                                          double per_c0, vec *uE, vec *PE)
{
    const vec zero = {0.0, 0.0, 0.0, 0.0};
    vec jump = ul - ur;
    *uE = (Zl * ul + Zr * ur + Pl - Pr) * inverse;
    if (low)
        jump *= vec_min(vec_all(1.0), 3.0 * per_c0 * vec_max(jump, zero));
    *PE = (Zr * Pl + Zl * Pr + Zl * Zr * jump) * inverse;
}

#endif
