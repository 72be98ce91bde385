/* riemann.h - states at the middle of a pair and the Riemann problem between them, for LANES pairs
 * at once. Inline parts of the second pass (riemann_loops.h); velocities are along the line of
 * centres.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_RIEMANN_H
#define SPH_RIEMANN_H

#include "../sph.h"
#include "vec.h"

/* Moves the values left and right of a pair to its middle. s = slope . (x_j - x_i) on either side,
 * D = right - left. Without bounds the step is Koren's. Both bounded forms are symmetric: the step
 * lies between 0 and D, so signs are folded away and one bound serves both sides.
 *   minmod [2.83]: 1/2 minmod(s, D)
 *   Koren: third order upwind-biased, (b + 2D)/6 with b = 2s - D the difference behind, bounded
 *   by b and D: minmod(b, (b + 2D)/6, D); its range is wider by slack at both ends, so that
 *   extrema of smooth fields, where D and b may have any signs, keep their third order */
INLINE void reconstruct(vec *left, vec *right, vec s_left, vec s_right, const int limiter,
                        const double slack)
{
    const vec zero = vec_all(0.0), D = *right - *left;
    const double third = 1.0 / 3.0;
    if (limiter == LIMITER_NONE) {
        *left += third * s_left + 0.5 * third * D;
        *right -= third * s_right + 0.5 * third * D;
        return;
    }
    const vec_bits sign = (vec_bits)D & (vec_bits)vec_all(-0.0);
    const vec size = (vec)((vec_bits)D ^ sign);
    vec l = (vec)((vec_bits)s_left ^ sign), r = (vec)((vec_bits)s_right ^ sign);
    if (limiter == LIMITER_MINMOD) {
        l = 0.5 * vec_min(vec_max(l, zero), size);
        r = 0.5 * vec_min(vec_max(r, zero), size);
    } else {
        const vec part = size * (0.5 * third), most = size + slack, behind = size - slack;
        const vec pass = vec_all(slack);
        const vec l_most = vec_max(vec_min(2.0 * l - behind, most), pass);
        const vec r_most = vec_max(vec_min(2.0 * r - behind, most), pass);
        l = vec_max(vec_min(third * l + part, l_most), -pass);
        r = vec_max(vec_min(third * r + part, r_most), -pass);
    }
    *left += (vec)((vec_bits)l ^ sign);
    *right -= (vec)((vec_bits)r ^ sign);
}

/* Tait's law [1.8-1.9] with gamma 7 or 1: p = B (rho/rho0)^gamma - at0, Z = rho c = Z0
 * (rho/rho0)^((gamma+1)/2). at0: B less the background pressure, which every pair then has in its
 * mean. */
struct tait {
    double rho0_1; /* 1/rho0 */
    double B, at0, Z0, c0;
};

static inline struct tait tait_of(const struct sph *s)
{
    const double B = s->rho0 * s->c0 * s->c0 / s->gamma;
    return (struct tait){.rho0_1 = 1.0 / s->rho0,
                         .B = B,
                         .at0 = B - s->background,
                         .Z0 = s->rho0 * s->c0,
                         .c0 = s->c0};
}

INLINE vec pressure(const struct tait *e, vec rho, const int gamma)
{
    const vec x = rho * e->rho0_1;
    if (gamma == 1)
        return e->B * x - e->at0;
    const vec x2 = x * x;
    return e->B * (x2 * x2 * (x2 * x)) - e->at0;
}

INLINE vec sound(const struct tait *e, vec rho, const int gamma)
{
    const vec x = rho * e->rho0_1;
    if (gamma == 1)
        return vec_all(e->c0);
    return e->c0 * (x * x * x);
}

INLINE vec impedance(const struct tait *e, vec rho, const int gamma)
{
    const vec x = rho * e->rho0_1;
    if (gamma == 1)
        return e->Z0 * x;
    const vec x2 = x * x;
    return e->Z0 * (x2 * x2);
}

/* Bounds of the dissipation: of the jump between the bounded states counts b = min(1, max(least,
 * factor (u_i - u_j))). */
struct dissipation {
    double factor; /* s/m: 3/c0 (Zhang, Hu & Adams, J. Comput. Phys. 335, 2017, eq. 17) */
    double least;  /* 1: full dissipation, as in [2.100] */
};

/* Weights of the linear Riemann problem between particles i and j a distance r apart, from their Z
 * = rho c. One division serves all. */
struct weights {
    vec r_1;   /* 1/r */
    vec share; /* Z_i/(Z_i + Z_j) */
    vec pull;  /* r/(Z_i + Z_j) */
    vec push;  /* Z_i Z_j/(Z_i + Z_j)/r */
};

INLINE struct weights weigh(vec r, vec Zi, vec Zj)
{
    const vec sum = Zi + Zj, shared = 1.0 / (r * sum), r_1 = shared * sum, sum_1 = shared * r;
    const vec share = Zi * sum_1;
    return (struct weights){r_1, share, r * sum_1, share * Zj * r_1};
}

/* Star state [2.100] between p[0], v[0] at i and p[1], v[1] at j. v: velocities along x_j - x_i
 * times r, as the sums have them; sets vE = r u_E and pE. The bound of the dissipation acts on p_E
 * only. What it leaves takes `even' instead, a share of the jump that states of third order have:
 * 2/3 of what the mean of both slopes exceeds v_j - v_i by. It is 0 in linear flow and of third
 * order in smooth flow, where the bounded states, cut at every extremum, let such a share take c0
 * times a jump of first order: half of what a gentle wave lost in five periods. Particles out of
 * order have most of their jump. */
INLINE void star(const struct dissipation *d, const struct weights *z, const vec p[2],
                 const vec v[2], vec even, vec *vE, vec *pE)
{
    const vec dv = v[0] - v[1], dp = p[0] - p[1];
    const vec b = vec_min(vec_max(dv * z->r_1 * d->factor, vec_all(d->least)), vec_all(1.0));
    *vE = v[1] + z->share * dv + z->pull * dp;
    *pE = p[0] - z->share * dp + z->push * (b * (dv - even) + even);
}

#endif
