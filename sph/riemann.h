/* riemann.h - states at the middle of a pair and the Riemann problem between them, for LANES pairs at
 * once. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_RIEMANN_H
#define SPH_RIEMANN_H

#include "sph.h"
#include "vec_pair.h"

/* Moves the values left and right of a pair to its middle. s = slope . (x_j - x_i) on either side,
 * D = right - left. Without bounds the step is s/2. Both bounded forms are symmetric: the step
 * lies between 0 and D, so signs are folded away and one bound serves both sides.
 *   minmod [2.83]: 1/2 minmod(s, D)
 *   Koren: third order upwind-biased, (b + 2D)/6 with b = 2s - D the difference behind, bounded
 *   by b and D: minmod(b, (b + 2D)/6, D) */
INLINE void reconstruct(vec *left, vec *right, vec s_left, vec s_right, const int limiter)
{
    const vec zero = vec_all(0.0), D = *right - *left;
    if (limiter == LIMITER_NONE) {
        *left += 0.5 * s_left;
        *right -= 0.5 * s_right;
        return;
    }
    const vec_bits sign = (vec_bits)D & (vec_bits)vec_all(-0.0);
    const vec size = (vec)((vec_bits)D ^ sign);
    vec l = (vec)((vec_bits)s_left ^ sign), r = (vec)((vec_bits)s_right ^ sign);
    if (limiter == LIMITER_MINMOD) {
        l = 0.5 * vec_min(vec_max(l, zero), size);
        r = 0.5 * vec_min(vec_max(r, zero), size);
    } else {
        const double third = 1.0 / 3.0;
        const vec part = size * (0.5 * third);
        l = vec_max(vec_min(vec_min(2.0 * l - size, third * l + part), size), zero);
        r = vec_max(vec_min(vec_min(2.0 * r - size, third * r + part), size), zero);
    }
    *left += (vec)((vec_bits)l ^ sign);
    *right -= (vec)((vec_bits)r ^ sign);
}

/* Tait's law: p = B [(rho/rho0)^gamma - 1] and Z = rho c = Z0 (rho/rho0)^((gamma+1)/2). */
struct tait {
    double rho0_1; /* 1/rho0 */
    double B, Z0;
};

INLINE void pressure(const struct tait *e, vec rho, vec *p, vec *Z, const int gamma)
{
    const vec x = rho * e->rho0_1;
    if (gamma == 1) {
        *p = e->B * x - e->B;
        *Z = e->Z0 * x;
    } else {
        const vec x2 = x * x, x3 = x2 * x, x4 = x2 * x2;
        *p = e->B * (x4 * x3) - e->B;
        *Z = e->Z0 * x4;
    }
}

/* What the bounds of the dissipation need: b = min(1, max(least, factor (u_i - u_j))). */
struct dissipation {
    double factor; /* s/m: 3/c0 (Zhang, Hu & Adams, J. Comput. Phys. 335, 2017, eq. 17) */
    double least;  /* 1: none is left out [2.100] */
};

/* Linear Riemann problem [2.100] between states (p, Z, v) left and right of a pair; v: velocities
 * along x_j - x_i, times r as the sums have them. Gives r u_E and p_E. inverse: 1/(Z_l + Z_r). */
INLINE void star(const struct dissipation *d, const vec p[2], const vec Z[2], const vec v[2], vec r,
                 vec r_1, vec inverse, vec *vE, vec *pE)
{
    const vec jump = (v[0] - v[1]) * r_1;
    const vec b = vec_min(vec_max(jump * d->factor, vec_all(d->least)), vec_all(1.0));
    *vE = (Z[0] * v[0] + Z[1] * v[1] + r * (p[0] - p[1])) * inverse;
    *pE = (Z[1] * p[0] + Z[0] * p[1] + Z[0] * Z[1] * (b * jump)) * inverse;
}

#endif
