/* riemann_loops.h - the parts of the second pass of Riemann SPH that do not depend on how far a
 * kernel reaches: riemann_rows.h combines them for particles of one size, refinement/mixed_pairs.c
 * for sets of several sizes. Four loops over batches of neighbours: geometry, densities and
 * pressures at the middle, velocities there, star states and fluxes.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_RIEMANN_LOOPS_H
#define SPH_RIEMANN_LOOPS_H

#include "../sph.h"
#include "kernel.h"
#include "kernel_sums.h"
#include "riemann.h"
#include "riemann_exact.h"
#include "scheme.h"
#include "vec.h"

/* A third value of enum sph_viscosity, for flows without viscosity; vectors of neighbours that go
 * through the four loops together. */
enum { VISCOSITY_OFF = 2, BATCH = 8 };

/* What is fixed at compile time for an instance of the pass. Limiter and gamma are tested at run
 * time: that cost nothing measurable, and leaves 12 instances. */
struct riemann_variant {
    int dim, scheme, viscosity; /* 2 or 3; enum sph_scheme; enum sph_viscosity or VISCOSITY_OFF */
    bool exact;                 /* Riemann problems are solved exactly */
};

/* Constants of the whole pass, from the parameters and the stage. */
struct riemann_constants {
    struct tait eos;
    struct dissipation dissipation; /* bound of it (Zhang, Hu & Adams 2017) */
    int limiter, gamma;             /* enum sph_limiter; 1 or 7 */
    double R_1, eps2;               /* 1/m; m^2: keeps r > 0 */
    double kernel;                  /* 2 |W'|/r = kernel (1 - r/R)^3 */
    double damper;                  /* beta rho0 c0 R, Pa s */
    double c2_1;                    /* 1/c0^2 */
    double mu;                      /* Pa s, times dim + 2 for Monaghan-Gingold */
    double even;                    /* 2/3 of the share of the jump of third order */
    double slack_rho, slack_u;      /* kg/m^3, m/s: what limiters let pass */
    double sharp[2];                /* weights of u_j - u_i and its estimates in the viscous term */
    double moment;                  /* 1/4: of the moment of shift fluxes, see solve */
};

/* The particle whose row is treated, the same in all lanes. */
struct riemann_own {
    vec x[3], u[3], rho, grho[3], gu[3][3], u0[3];
    vec w;      /* with the kernel's constant */
    vec Z;      /* rho c */
    vec damped; /* what the acoustic damper takes from p */
};

/* Vectors of neighbours of one row between the loops that treat them. */
struct riemann_batch {
    int n;                               /* vectors in use, at most BATCH */
    vec d[3][BATCH];                     /* x_j - x_i */
    vec f[BATCH];                        /* 2 w_i w_j |W'|/r */
    struct weights weights[BATCH];       /* of both states in the star state */
    vec rho[BATCH];                      /* of j; then the mean of both states */
    vec D[3][BATCH];                     /* u_j - u_i as friction takes it */
    vec parting[BATCH];                  /* (u_j - u_i).(x_j - x_i) */
    vec even[BATCH];                     /* share of the jump of third order, see star */
    vec u[2][3][BATCH], p[2][BATCH];     /* states at the middle: i's side, j's side */
    vec Q[BATCH], m[2][BATCH], w[BATCH]; /* fluxes of momentum, of mass, of volume */
    vec rub[BATCH];                      /* times D: momentum that goes to i */
    vec x[2][BATCH];                     /* rho/rho0 of both states, for exact problems */
};

/* What the pairs contribute to the rates of their first particle: momentum, volume, mass. */
struct riemann_sums {
    vec q[3], w, m;
};

/* Over c0: jumps of u that limiters let pass. Small extrema, but not in a region with open sides
 * that has walls (a contraction there loses 2 % more of its pressure, vortices between slip walls
 * err by 1.1 instead of 0.4 %) or a surface. Extrema that limiters cut gain energy by the way they
 * are moved: two modes at rest in a coupled box with 22 spacings to a wave erred by 1.3 instead of
 * 0.5 %. Under a surface what friction holds: no wiggle grows out of jumps whose Reynolds number by
 * dx is below 1. Where the limiter cut them, a standing wave of 12 rows got back a tenth of what
 * friction took from it. Not beside dissipation of third order, which with 25 rows is nearer as it
 * is (1.9, else 5.1 % off; with 12 rows 30, else 4.7). */
static double slack(const struct sph *s)
{
    const double small = 0.02;
    if (s->surface)
        return s->zones || s->prm.dissipation_order == DISSIPATION_THIRD
                   ? 0.0
                   : fmin(small, s->nu / (s->c0 * s->dx));
    return s->zones && s->walls ? 0.0 : small;
}

/* The least share of the dissipation, -. It takes c0 times a jump, which in a stream slower than
 * c0/20 is more than the stream's own forces: there it goes down with the square of the speed. A
 * box of six spacings in 0.3 m/s under a surface, c0 105 times that: drag 40 N/m with the whole
 * share, 26 without any, 32 with one in proportion to the speed, 28 so (`fv` 20, with twice the
 * cells 31). */
static double least_share(const struct sph *s)
{
    const double swift = fmin(20.0 * s->step.stray / s->c0, 1.0);
    return s->prm.dissipation * fmax(swift * swift, 1.0 - scheme_streams(s));
}

/* What is left of it for the jump between bounded states. Under a surface friction keeps particles
 * in order, too: at the distance of dx it acts on the jump as the share 2 (D + 2) nu/(c0 dx) would.
 * Not in a region with open sides: there it held the wave of a coupled job to 4.6 instead of 1.9 %.
 */
static double bounded_share(const struct sph *s)
{
    const bool rubs = s->surface && !s->zones;
    if (!s->prm.low_dissipation)
        return 1.0;
    if (s->prm.dissipation_order == DISSIPATION_THIRD)
        return 0.0;
    const double friction = rubs ? 2.0 * (s->dim + 2.0) * s->nu / (s->c0 * s->dx) : 0.0;
    return fmax(0.0, least_share(s) - friction);
}

static struct riemann_constants constants_of(const struct sph *s)
{
    const bool filled = !s->surface, whole = filled && !s->walls;
    const bool third = s->prm.dissipation_order == DISSIPATION_THIRD;
    return (struct riemann_constants){
        .eos = tait_of(s),
        .dissipation = {.factor = 3.0 / s->c0, .least = bounded_share(s)},
        .even = third ? 2.0 / 3.0 * least_share(s) : 0.0,
        .limiter = s->prm.limiter,
        .gamma = (int)s->gamma,
        .R_1 = 1.0 / s->R,
        .eps2 = 1e-20 * s->R * s->R,
        .kernel = -2.0 * kernel_dw_r(s->dim, 0.0, s->R),
        .damper = s->prm.damper * s->rho0 * s->c0 * s->R,
        .c2_1 = 1.0 / (s->c0 * s->c0),
        .mu =
            kernel_pair_viscosity(s) * (s->prm.viscosity == VISCOSITY_MORRIS ? 1.0 : s->dim + 2.0),
        .slack_rho = 0.1 * slack(s) * s->rho0,
        .slack_u = slack(s) * s->c0,
        .sharp = {whole ? 4.0 / 3.0 : 1.0, whole ? -1.0 / 6.0 : 0.0},
        .moment = filled && s->prm.transport != TRANSPORT_EULERIAN ? 0.25 : 0.0,
    };
}

/* The particle with these packed records, spread over all lanes. */
INLINE struct riemann_own load_own(const struct riemann_constants *c, const double *prim,
                                   const double *slope, const struct riemann_variant v)
{
    const int dim = v.dim;
    const double *g = slope + dim, *u0 = g + dim * dim;
    struct riemann_own i;
    double divergence = 0.0;
    for (int a = 0; a < dim; a++) {
        i.x[a] = vec_all(prim[a]);
        i.u[a] = vec_all(prim[dim + a]);
        i.grho[a] = vec_all(slope[a]);
        i.u0[a] = vec_all(u0[a]);
        for (int b = 0; b < dim; b++)
            i.gu[a][b] = vec_all(g[dim * a + b]);
        divergence += g[dim * a + a];
    }
    i.w = vec_all(c->kernel * prim[at_volume(dim)]);
    i.rho = vec_all(prim[at_rho(dim)]);
    i.Z = impedance(&c->eos, i.rho, c->gamma);
    i.damped =
        vec_all(c->damper * (divergence - (dim == 2 ? prim[PRIM_FALSE] : slope[SLOPE_FALSE])));
    return i;
}

/* Second loop: states at the middle [2.78-2.83] of rho, pressures of both. */
INLINE void densities(const struct riemann_constants *c, const struct riemann_own *i,
                      const double *slope, const int *j, struct riemann_batch *t,
                      const struct riemann_variant v)
{
    const int dim = v.dim;
    for (int k = 0; k < t->n; k++, j += LANES) {
        vec d[3], g[3], spare, rho[2] = {i->rho, t->rho[k]};
        vec_columns(slope, dim == 2 ? 8 : 16, j, 0, g, g + 1);
        if (dim == 3)
            vec_columns(slope, 16, j, 2, g + 2, &spare);
        for (int a = 0; a < dim; a++)
            d[a] = t->d[a][k];
        reconstruct(rho, rho + 1, vec_dot(i->grho, d, dim), vec_dot(g, d, dim), c->limiter,
                    c->slack_rho);
        t->rho[k] = 0.5 * (rho[0] + rho[1]);
        t->p[0][k] = pressure(&c->eos, rho[0], c->gamma) - i->damped;
        t->p[1][k] = pressure(&c->eos, rho[1], c->gamma);
        if (v.exact) {
            t->x[0][k] = rho[0] * c->eos.rho0_1;
            t->x[1][k] = rho[1] * c->eos.rho0_1;
        }
    }
}

/* The velocity gradients of LANES neighbours j. */
INLINE void load_gu(const double *slope, const int *j, vec gu[3][3], const int dim)
{
    vec spare;
    if (dim == 2) {
        vec_columns(slope, 8, j, 2, gu[0], gu[0] + 1);
        vec_columns(slope, 8, j, 4, gu[1], gu[1] + 1);
    } else {
        vec_columns(slope, 16, j, 2, &spare, gu[0]);
        vec_columns(slope, 16, j, 4, gu[0] + 1, gu[0] + 2);
        vec_columns(slope, 16, j, 6, gu[1], gu[1] + 1);
        vec_columns(slope, 16, j, 8, gu[1] + 2, gu[2]);
        vec_columns(slope, 16, j, 10, gu[2] + 1, gu[2] + 2);
    }
}

/* Third loop: the same of the components of u, and the acoustic damper of j. */
INLINE void velocities(const struct riemann_constants *c, const struct riemann_own *i,
                       const struct sph *s, const int *j, struct riemann_batch *t,
                       const struct riemann_variant v)
{
    const int dim = v.dim;
    for (int k = 0; k < t->n; k++, j += LANES) {
        vec d[3], u[3], gu[3][3], spare, false_divergence;
        for (int a = 0; a < dim; a++)
            d[a] = t->d[a][k];
        load_gu(s->p.slope, j, gu, dim);
        if (dim == 2) {
            vec_columns(s->p.prim, PRIM, j, 2, u, u + 1);
            vec_columns(s->p.prim, PRIM, j, PRIM_FALSE, &false_divergence, &spare);
        } else {
            vec_columns(s->p.slope, 16, j, SLOPE_FALSE - 1, &spare, &false_divergence);
            vec_columns(s->p.prim, PRIM, j, 2, &spare, u);
            vec_columns(s->p.prim, PRIM, j, 4, u + 1, u + 2);
        }
        const vec divergence = dim == 2 ? gu[0][0] + gu[1][1] : gu[0][0] + gu[1][1] + gu[2][2];
        t->p[1][k] -= c->damper * (divergence - false_divergence);
        vec parting = vec_all(0.0), slopes = vec_all(0.0);
        for (int a = 0; a < dim; a++) {
            const vec step[2] = {vec_dot(i->gu[a], d, dim), vec_dot(gu[a], d, dim)};
            vec left = i->u[a], right = u[a], D = right - left;
            parting += D * d[a];
            slopes += (step[0] + step[1]) * d[a];
            if (v.viscosity == VISCOSITY_MORRIS)
                D = c->sharp[0] * D + c->sharp[1] * (step[0] + step[1]);
            t->D[a][k] = D;
            reconstruct(&left, &right, step[0], step[1], c->limiter, c->slack_u);
            t->u[0][a][k] = left;
            t->u[1][a][k] = right;
        }
        t->parting[k] = parting;
        t->even[k] = c->even * (0.5 * slopes - parting);
    }
}

/* Their transport velocities. */
INLINE void load_u0(const double *slope, const int *j, vec u0[3], const int dim)
{
    vec spare;
    if (dim == 2) {
        vec_columns(slope, 8, j, 6, u0, u0 + 1);
    } else {
        vec_columns(slope, 16, j, 12, u0, u0 + 1);
        vec_columns(slope, 16, j, 14, u0 + 2, &spare);
    }
}

/* Rows of the sums: momentum, volume, mass; 8 doubles in 3D, where the mass has no place in the
 * first four. */
INLINE void add_to_neighbours(double *sums, const int *j, const vec *q, vec w, vec m,
                              const struct riemann_variant v)
{
    if (v.dim == 2) {
        vec_add_rows(sums, 4, j, q[0], q[1], w, m);
        return;
    }
    vec_add_rows(sums, 8, j, q[0], q[1], q[2], w);
    if (v.scheme == SCHEME_RIEMANN_ALE)
        for (int l = 0; l < LANES; l++)
            sums[8 * (ptrdiff_t)j[l] + 4] += m[l];
}

/* Fourth loop: star states and what goes along the line of centres. */
INLINE void solve(const struct riemann_constants *c, const struct riemann_own *i,
                  const struct sph *s, const int *j, struct riemann_batch *t,
                  const struct riemann_variant v)
{
    const int dim = v.dim;
    for (int k = 0; k < t->n; k++, j += LANES) {
        const struct weights *z = t->weights + k;
        const vec f = t->f[k], p[2] = {t->p[0][k], t->p[1][k]}, r2_1 = z->r_1 * z->r_1;
        vec d[3], uI[3], uJ[3], vE, pE;
        for (int a = 0; a < dim; a++) {
            d[a] = t->d[a][k];
            uI[a] = t->u[0][a][k];
            uJ[a] = t->u[1][a][k];
        }
        const vec V[2] = {vec_dot(uI, d, dim), vec_dot(uJ, d, dim)};
        star(&c->dissipation, z, p, V, t->even[k], &vE, &pE);
        if (v.exact)
            add_exact(&c->eos, z, (vec[2]){t->x[0][k], t->x[1][k]}, V, c->gamma, &vE, &pE);
        vec Q = f * pE;                        /* times d: what acts along the line of centres */
        if (v.viscosity == VISCOSITY_MONAGHAN) /* [2.32] */
            Q -= c->mu * f * t->parting[k] * r2_1;
        t->rub[k] = f * (v.viscosity == VISCOSITY_MORRIS ? c->mu : 0.0); /* [2.31] */
        if (v.scheme == SCHEME_RIEMANN_ALE) {
            /* rho_E = EOS^-1(p_E) about the mean state, where the damper cancels; the tangential
             * part of u_E is that of the side the fluid comes from. */
            vec u0[3];
            load_u0(s->p.slope, j, u0, dim);
            const vec S[2] = {vec_dot(i->u0, d, dim), vec_dot(u0, d, dim)};
            const vec rho = t->rho[k] + c->c2_1 * (pE - 0.5 * (p[0] + p[1]));
            const vec m = f * rho * (vE - 0.5 * (S[0] + S[1])); /* [2.88] */
            const vec mI = vec_max(m, vec_all(0.0)), mJ = m - mI;
            Q += (m * vE - mI * V[0] - mJ * V[1]) * r2_1;
            t->m[0][k] = mI;
            t->m[1][k] = mJ;
            t->w[k] = 0.5 * f * (S[1] - S[0]); /* [2.87], the same for both */
            t->rub[k] += c->moment * f * rho * (S[0] - S[1] + t->parting[k]);
        } else {
            const vec ui = vec_dot(i->u, d, dim);
            t->w[k] = f * (ui + t->parting[k] - vE); /* [2.97] */
            t->m[0][k] = f * (vE - ui);              /* of i */
        }
        t->Q[k] = Q;
    }
}

/* From the last row on: rows of the sums stand where those of rates will, which are longer. */
INLINE void write_rates(struct sph *s, const double *sums, const int dim)
{
    const int nsums = dim == 2 ? 4 : 8;
    for (int i = s->p.n - 1; i >= 0; i--) {
        double row[5] = {0.0};
        memcpy(row, sums + (ptrdiff_t)nsums * i, (size_t)(dim + 2) * sizeof *row);
        const double *y = state_row(&s->p, s->p.y, i);
        const double *u0 = slope_line(&s->p, i) + dim + dim * dim;
        double *rate = state_row(&s->p, s->p.rate, i);
        for (int a = 0; a < dim; a++) {
            rate[a] = u0[a];
            rate[dim + a] = row[a] + y[at_mass(dim)] * s->gravity[a];
        }
        rate[at_volume(dim)] = row[dim];
        rate[at_mass(dim)] = row[dim + 1];
    }
}

#endif
