/* riemann_exact.h - the exact solution of the Riemann problem of a pair in Tait's gas, LANES pairs
 * at once, for comparison with the linear one [2.100] of riemann.h. The gas is barotropic, so both
 * sides of the star state have one density, x rho0, and that is what Newton's iteration looks for:
 * u_i - f(x, x_i) = u_j + f(x, x_j), f the jump of velocity across a shock (x > x_i; from the jumps
 * of mass and momentum) or a rarefaction (x < x_i; from its invariant).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_RIEMANN_EXACT_H
#define SPH_RIEMANN_EXACT_H

#include "riemann.h"

INLINE vec choose(vec_bits first, vec a, vec b)
{
    return (vec)((first & (vec_bits)a) | (~first & (vec_bits)b));
}

/* f(x, a)/c0 of a shock, which is (x - a) sqrt((x^7 - a^7)/(x - a)/(7 x a)) with gamma = 7, and its
 * slope: nothing is divided by the strength, which may be 0. */
INLINE vec shock(vec x, vec a, const int gamma, vec *slope)
{
    vec sum = vec_all(1.0), rise = vec_all(0.0), power = a; /* sum of x^m a^(6 - m); its slope */
    for (int m = 1; gamma == 7 && m < 7; m++) {
        rise = rise * x + sum;
        sum = sum * x + power;
        power *= a;
    }
    const vec g = vec_sqrt(sum / ((double)gamma * x * a)), f = (x - a) * g;
    *slope = g + 0.5 * f * (rise / sum - 1.0 / x);
    return f;
}

/* The same of a rarefaction: 2/(gamma - 1) times the change of c/c0, the logarithm with gamma = 1.
 */
INLINE vec rarefaction(vec x, vec a, const int gamma, vec *slope)
{
    vec f = (x * x * x - a * a * a) * (1.0 / 3.0);
    *slope = x * x;
    for (int l = 0; gamma == 1 && l < LANES; l++) {
        f[l] = log(x[l] / a[l]);
        (*slope)[l] = 1.0 / x[l];
    }
    return f;
}

INLINE vec jump(vec x, vec a, const int gamma, vec *slope)
{
    vec steep, flat;
    const vec up = shock(x, a, gamma, &steep), down = rarefaction(x, a, gamma, &flat);
    const vec_bits rises = x > a;
    *slope = choose(rises, steep, flat);
    return choose(rises, up, down);
}

/* The star state's density over rho0 between states of densities a, dv = (u_i - u_j)/c0; the
 * velocity less the mean of both, over c0, into *drift. Both f are convex: from the second step on
 * x falls to the root, from below it does not fall under half of what it was. States that part
 * faster than a gas can follow end near vacuum. */
INLINE vec exact_density(const vec a[2], vec dv, const int gamma, vec *drift)
{
    vec x = 0.5 * (a[0] + a[1]), slope[2], f[2];
    for (int n = 0; n < 20; n++) {
        f[0] = jump(x, a[0], gamma, slope);
        f[1] = jump(x, a[1], gamma, slope + 1);
        const vec before = x;
        x = vec_max(x - (f[0] + f[1] - dv) / (slope[0] + slope[1]), 0.5 * x);
        if (!(vec_less(1e-7 * x, x - before) | vec_less(1e-7 * x, before - x)))
            break; /* the next step would be a square of that */
    }
    *drift = 0.5 * (jump(x, a[1], gamma, slope) - jump(x, a[0], gamma, slope));
    return x;
}

/* Adds to the linear star state of star() what the exact one between densities x (over rho0) and
 * velocities v differs from the linear one with full dissipation. What the acoustic damper and the
 * bounds of the dissipation make of the linear state, which no gas has, stays: without them the sum
 * is the exact state. */
INLINE void add_exact(const struct tait *e, const struct weights *z, const vec x[2], const vec v[2],
                      const int gamma, vec *vE, vec *pE)
{
    const vec least = vec_all(0.05), a[2] = {vec_max(x[0], least), vec_max(x[1], least)};
    const double rho0 = 1.0 / e->rho0_1, c0 = e->c0;
    const vec dv = v[0] - v[1], r = 1.0 / z->r_1;
    const vec p[2] = {pressure(e, rho0 * a[0], gamma), pressure(e, rho0 * a[1], gamma)};
    const vec dp = p[0] - p[1];
    vec drift;
    const vec star = exact_density(a, dv * z->r_1 / c0, gamma, &drift);
    *vE += 0.5 * dv + c0 * drift * r - (z->share * dv + z->pull * dp);
    *pE += pressure(e, rho0 * star, gamma) - (p[0] - z->share * dp + z->push * dv);
}

#endif
