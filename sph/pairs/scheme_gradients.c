/* scheme_gradients.c - first pass over the pairs (Chiron 2017). One-sided: every particle sums over
 * its whole row of the list. Renormalised gradients [2.42-2.44], exact for linear fields,
 *   M_i = sum_j w_j (x_j - x_i) (x) grad W,   grad f_i = sum_j w_j (f_j - f_i) grad W . M_i^-1,
 * of rho and the components of u, and the velocity u0 at which particles are moved:
 *   tvs:   u0 = u - 2 U R sum_j dx^D (1 + (W_ij/W(dx))^4/5) grad W,   |u0 - u| <= U/4
 *   tvo:   u0 = u - U R_d sum_j dx^D grad W(R_d),   |u0 - u| <= |u|/4   (Oger) [2.112-2.114]
 *   xsph:  u0 = u + sum_j w_j rho_j (u_j - u_i)/(rho_i + rho_j) W_ij   [2.106]
 *   none:  u0 = u,   eulerian:  u0 = 0,
 * U from scheme_shift_speed, R_d = 2 dx, at most R. With walls or a free surface
 * surface/transport.c bounds the shift. Called first in every stage, before walls, surface and the
 * second pass, which read the slopes. Sums are kept in the lanes of vectors to the end of a row
 * (gradient_sums), added up once (total), renormalised (invert, renormalise) and written to slope
 * (write_slope).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scheme.h"

#include "../surface/sph_surface.h"
#include "eigenvalue.h"
#include "kernel.h"
#include "kernel_sums.h"
#include "neighbours.h"
#include "vec.h"

/* vectors of neighbours between two loops: d and t of a batch stay in the first-level cache */
enum { BATCH = 16 };

struct gradient_constants {
    double R_1, eps2; /* 1/m; m^2: keeps r > 0 */
    double kernel;    /* |W'|/r = kernel t^3, t = 1 - r/R */
    double W[2];      /* W/W(dx) = t^4 (W[0] - W[1] t) */
    double near;      /* R/R_delta of the law of Oger */
    double W0, Wdx;   /* W(0), W(dx) */
    double smoothed;  /* of X-SPH: 2 eps W(0) */
};

/* Vectors of neighbours of one row between the loops that treat them. */
struct gradient_batch {
    int n;
    vec d[3][BATCH]; /* x_j - x_i */
    vec t[BATCH];    /* 1 - r/R, 0 outside */
};

/* Sums over neighbours, without the kernel's constant. */
struct gradient_sums {
    vec M[6];    /* d_a d_b: 00 01 11 02 12 22 */
    vec rho[3];  /* (rho_j - rho_i) d_b */
    vec u[3][3]; /* (u_j - u_i)_a d_b */
    vec n[3];    /* crowding */
    vec W;       /* W/W(dx), where volumes follow it */
};

/* First loop: d = x_j - x_i and t = 1 - r/R of a batch. Short loops instead of one: the square root
 * is under way for several vectors at once. */
INLINE void geometry(const struct gradient_constants *c, const double *i, const double *prim,
                     const int *j, struct gradient_batch *near, const int dim)
{
    for (int k = 0; k < near->n; k++, j += LANES) {
        vec d[3], spare, r2 = vec_all(c->eps2);
        vec_columns(prim, PRIM, j, 0, d, d + 1);
        if (dim == 3)
            vec_columns(prim, PRIM, j, 2, d + 2, &spare);
        for (int a = 0; a < dim; a++) {
            d[a] -= i[a];
            r2 += d[a] * d[a];
            near->d[a][k] = d[a];
        }
        near->t[k] = vec_max(1.0 - vec_sqrt(r2) * c->R_1, vec_all(0.0));
    }
}

/* Weight of x_j - x_i in the crowding vector, over w0 and the kernel's constant; of the law over
 * the whole support W/W(dx), too. */
INLINE vec crowding(const struct gradient_constants *c, vec t, const int transport, vec *W_dx)
{
    if (transport == TRANSPORT_TVO) { /* the kernel of radius R_delta <= R */
        const vec q = vec_max((1.0 - c->near) + c->near * t, vec_all(0.0));
        return q * q * q;
    }
    const vec t2 = t * t, t3 = t2 * t, W = t2 * t2 * (c->W[0] - c->W[1] * t), W2 = W * W;
    *W_dx = W;
    return t3 + 0.2 * t3 * (W2 * W2);
}

/* Second loop: adds the contributions of a batch. `velocity' and `filled' are constants of the
 * instance, without them no velocities are loaded and no kernel sum is made. */
INLINE void add(const struct gradient_constants *c, const double *i, const double *prim,
                const int *j, const struct gradient_batch *near, struct gradient_sums *s,
                const int dim, const int transport, const bool velocity, const bool filled)
{
    for (int k = 0; k < near->n; k++, j += LANES) {
        const vec t = near->t[k];
        vec d[3], u[3], w, rho, spare;
        if (velocity && dim == 2) {
            vec_columns(prim, PRIM, j, 2, u, u + 1);
        } else if (velocity) {
            vec_columns(prim, PRIM, j, 2, &spare, u);
            vec_columns(prim, PRIM, j, 4, u + 1, u + 2);
        }
        vec_columns(prim, PRIM, j, at_volume(dim), &w, &rho);
        for (int a = 0; a < dim; a++) {
            d[a] = near->d[a][k];
            if (velocity)
                u[a] -= i[dim + a];
        }
        if (transport == TRANSPORT_XSPH) { /* [2.106] */
            const vec t2 = t * t, W = t2 * t2 * (5.0 - 4.0 * t);
            const vec weight = W * w * rho / (rho + i[at_rho(dim)]);
            for (int a = 0; a < dim; a++)
                s->n[a] += weight * u[a];
        }
        rho -= i[at_rho(dim)];
        const vec g = t * t * t * w;
        for (int b = 0, m = 0; b < dim; b++) {
            const vec gd = g * d[b];
            s->rho[b] += rho * gd;
            for (int a = 0; a < dim && velocity; a++)
                s->u[a][b] += u[a] * gd;
            for (int a = 0; a <= b; a++)
                s->M[m++] += d[a] * gd;
        }
        if (transport == TRANSPORT_TVS || transport == TRANSPORT_TVO) {
            vec W;
            const vec weight = crowding(c, t, transport, &W);
            for (int a = 0; a < dim; a++)
                s->n[a] += weight * d[a];
            if (filled)
                s->W += W * w;
        }
    }
}

/* Whether all eigenvalues of the symmetric M are above a bound: by Sylvester's criterion all
 * leading minors of M - bound I are positive. Spares the eigenvalues themselves inside the
 * fluid. */
INLINE bool exceeds(const double *M, double bound, const int dim)
{
    const double a = M[0] - bound, b = M[1], e = M[2] - bound;
    if (dim == 2)
        return a > 0.0 && a * e > b * b;
    const double c = M[3], h = M[4], i = M[5] - bound;
    return a > 0.0 && a * e > b * b &&
           a * (e * i - h * h) - b * (b * i - h * c) + c * (b * h - e * c) > 0.0;
}

/* All entries [dim][dim] of a symmetric matrix from those of its half, which are stored in the
 * order 00 01 11 02 12 22. */
INLINE void unpack(const double *M, double *all, const int dim)
{
    all[0] = M[0];
    all[1] = all[dim] = M[1];
    all[dim + 1] = M[2];
    if (dim == 3) {
        all[2] = all[6] = M[3];
        all[5] = all[7] = M[4];
        all[8] = M[5];
    }
}

/* Share of the gradients that counts: all where the eigenvalues of M are above 0.2, none where one
 * is below 0.1. A step instead of the ramp switches the pressure of particles in the corner of
 * surface and wall on and off: bursts of 5e-4 c0 in water at rest, 1e-4 without; by a ramp from 0.3
 * to 0.2 a tank falls apart, for there the gradients are what balances the weight. */
static double trusted(const double *M, const int dim)
{
    static const double least = 0.1, enough = 0.2;
    if (exceeds(M, enough, dim))
        return 1.0;
    if (!exceeds(M, least, dim))
        return 0.0;
    double all[9];
    unpack(M, all, dim);
    const double lambda = eigenvalue_smallest(all, dim);
    return (lambda - least) / (enough - least);
}

/* B = M^-1 for symmetric M by cofactors, times the share that can be trusted; zero where the share
 * is 0, so that a singular M divides nothing. */
INLINE void invert(const double *M, double B[3][3], const int dim)
{
    const double share = trusted(M, dim);
    if (dim == 2) {
        const double f = share > 0.0 ? share / (M[0] * M[2] - M[1] * M[1]) : 0.0;
        B[0][0] = f * M[2];
        B[0][1] = B[1][0] = -f * M[1];
        B[1][1] = f * M[0];
        return;
    }
    const double c00 = M[2] * M[5] - M[4] * M[4], c01 = M[3] * M[4] - M[1] * M[5];
    const double c02 = M[1] * M[4] - M[2] * M[3];
    const double f = share > 0.0 ? share / (M[0] * c00 + M[1] * c01 + M[3] * c02) : 0.0;
    B[0][0] = f * c00;
    B[0][1] = B[1][0] = f * c01;
    B[0][2] = B[2][0] = f * c02;
    B[1][1] = f * (M[0] * M[5] - M[3] * M[3]);
    B[1][2] = B[2][1] = f * (M[1] * M[3] - M[0] * M[4]);
    B[2][2] = f * (M[0] * M[2] - M[1] * M[1]);
}

/* Sums over neighbours, over the lanes too. */
struct totals {
    double M[6], rho[3], u[3][3], n[3], W;
};

/* Adds up the lanes, four sums at a time. Entries that a variant has not summed are zeros, and the
 * compiler leaves them out. */
INLINE struct totals total(const struct gradient_sums *s, const int dim)
{
    const vec none = vec_all(0.0);
    struct totals t;
    if (dim == 2) {
        const vec4 M = vec_sums(s->M[0], s->M[1], s->M[2], s->W);
        const vec4 f = vec_sums(s->rho[0], s->rho[1], s->n[0], s->n[1]);
        const vec4 u = vec_sums(s->u[0][0], s->u[0][1], s->u[1][0], s->u[1][1]);
        for (int a = 0; a < 3; a++)
            t.M[a] = M[a];
        t.W = M[3];
        for (int a = 0; a < 2; a++) {
            t.rho[a] = f[a];
            t.n[a] = f[2 + a];
            t.u[0][a] = u[a];
            t.u[1][a] = u[2 + a];
        }
        return t;
    }
    const vec4 M = vec_sums(s->M[0], s->M[1], s->M[2], s->M[3]);
    const vec4 rho = vec_sums(s->rho[0], s->rho[1], s->rho[2], s->M[4]);
    const vec4 n = vec_sums(s->n[0], s->n[1], s->n[2], s->M[5]);
    for (int a = 0; a < 4; a++)
        t.M[a] = M[a];
    t.M[4] = rho[3];
    t.M[5] = n[3];
    for (int a = 0; a < 3; a++) {
        const vec4 u = vec_sums(s->u[a][0], s->u[a][1], s->u[a][2], a == 0 ? s->W : none);
        t.rho[a] = rho[a];
        t.n[a] = n[a];
        t.W = a == 0 ? u[3] : t.W;
        for (int b = 0; b < 3; b++)
            t.u[a][b] = u[b];
    }
    return t;
}

/* out_b = kernel sum_a v_a B_ab: the gradient from the moments v without the kernel's constant,
 * kernel = 20 W(0)/R^2. */
INLINE void renormalise(double *out, const double *v, double B[3][3], double kernel, const int dim)
{
    for (int b = 0; b < dim; b++) {
        double sum = 0.0;
        for (int a = 0; a < dim; a++)
            sum += v[a] * B[a][b];
        out[b] = kernel * sum;
    }
}

/* R_delta = 2 dx of the law of Oger, never more than R. */
INLINE double oger_radius(const struct sph *s) { return 2.0 * s->dx < s->R ? 2.0 * s->dx : s->R; }

/* u0 - u from the crowding vector without its constants. Whole-support law: -2 U R n, at most U/4.
 * Law of Oger [2.113-2.114]: -U n R_delta, at most |u|/4. */
INLINE void shift(const struct sph *s, int i, double *delta, const double *u, const double *n,
                  const int dim, const int transport)
{
    const double U = scheme_shift_speed(s, i);
    const double R = transport == TRANSPORT_TVO ? oger_radius(s) : s->R;
    const double factor =
        (transport == TRANSPORT_TVO ? U : 2.0 * U) * R * s->dxD * kernel_dw_r(dim, 0.0, R);
    double size2 = 0.0, u2 = 0.0;
    for (int a = 0; a < dim; a++) {
        delta[a] = factor * n[a];
        size2 += delta[a] * delta[a];
        u2 += u[a] * u[a];
    }
    const double most2 = 0.0625 * (transport == TRANSPORT_TVO ? u2 : U * U);
    if (size2 > most2 && !s->walls && !s->surface) /* else transport.c has the last word */
        for (int a = 0; a < dim; a++)
            delta[a] *= sqrt(most2 / size2);
}

/* Finishes particle i: writes grad rho, grad u and u0 to its slope record, M for surface detection
 * where that is under way, and the kernel sum of how filled its support is; the trace of M over D.
 */
INLINE double write_slope(const struct sph *s, const struct gradient_constants *c,
                          const struct gradient_sums *sum, int i, const int dim,
                          const int transport, const bool velocity, const bool filled)
{
    const double *u = prim_line(&s->p, i) + dim;
    double *slope = slope_line(&s->p, i), *u0 = slope + dim + dim * dim;
    double B[3][3], delta[3] = {0.0, 0.0, 0.0};
    struct totals t = total(sum, dim);
    for (int k = 0; k < dim * (dim + 1) / 2; k++)
        t.M[k] *= c->kernel;
    if (s->surface && !s->surface->known)
        unpack(t.M, s->surface->M + (ptrdiff_t)(dim * dim) * i, dim);
    if (filled)
        s->surface->less[i] = u[at_volume(dim) - dim] * c->W0 + c->Wdx * t.W;
    invert(t.M, B, dim);
    renormalise(slope, t.rho, B, c->kernel, dim);
    for (int a = 0; a < dim && velocity; a++)
        renormalise(slope + dim + dim * a, t.u[a], B, c->kernel, dim);
    if (transport == TRANSPORT_TVS || transport == TRANSPORT_TVO)
        shift(s, i, delta, u, t.n, dim, transport);
    if (transport == TRANSPORT_XSPH)
        for (int a = 0; a < dim; a++)
            delta[a] = c->smoothed * t.n[a];
    for (int a = 0; a < dim; a++)
        u0[a] = transport == TRANSPORT_EULERIAN ? 0.0 : u[a] + delta[a];
    return dim == 2 ? 0.5 * (t.M[0] + t.M[2]) : (t.M[0] + t.M[2] + t.M[5]) / 3.0;
}

/* One body for all laws of transport; constants in each instance drop what it does not need. */
INLINE void pass(struct sph *s, const int dim, const int transport, const bool velocity,
                 const bool filled)
{
    const struct neighbours *l = s->list;
    const double R = s->R, Wdx = kernel_w(dim, s->dx, R) / kernel_w0(dim, R);
    const struct gradient_constants c = {.R_1 = 1.0 / R,
                                         .eps2 = 1e-20 * R * R,
                                         .kernel = -kernel_dw_r(dim, 0.0, R),
                                         .W = {5.0 / Wdx, 4.0 / Wdx},
                                         .near = R / oger_radius(s),
                                         .W0 = kernel_w0(dim, R),
                                         .Wdx = kernel_w(dim, s->dx, R),
                                         .smoothed = kernel_w0(dim, R)}; /* 2 eps = 1 */
    const bool asked = kernel_moment_asked(s);
    for (int k = l->begin; k < l->end; k++) {
        const int i = neighbours_row(l, k);
        const double *own = prim_line(&s->p, i);
        const int *j = l->j + l->start[i];
        struct gradient_sums sum = {0};
        for (int left = (l->count[i] + LANES - 1) / LANES; left > 0; left -= BATCH) {
            struct gradient_batch near;
            near.n = left < BATCH ? left : BATCH;
            geometry(&c, own, s->p.prim, j, &near, dim);
            add(&c, own, s->p.prim, j, &near, &sum, dim, transport, velocity, filled);
            j += BATCH * LANES;
        }
        const double moment = write_slope(s, &c, &sum, i, dim, transport, velocity, filled);
        if (asked)
            kernel_moment_add(s, i, moment);
    }
}

/* Whether the surface is yet to be found, where volumes follow kernel sums. */
static bool asks_how_filled(const struct sph *s)
{
    return s->surface && s->surface->follows && !s->surface->known;
}

#define LAWS(dim)                                                                                  \
    static void tvs_##dim(struct sph *s)                                                           \
    {                                                                                              \
        if (asks_how_filled(s))                                                                    \
            pass(s, dim, TRANSPORT_TVS, true, true);                                               \
        else                                                                                       \
            pass(s, dim, TRANSPORT_TVS, true, false);                                              \
    }                                                                                              \
    static void tvo_##dim(struct sph *s) { pass(s, dim, TRANSPORT_TVO, true, false); }             \
    static void none_##dim(struct sph *s) { pass(s, dim, TRANSPORT_NONE, true, false); }           \
    static void eulerian_##dim(struct sph *s) { pass(s, dim, TRANSPORT_EULERIAN, true, false); }   \
    static void xsph_##dim(struct sph *s) { pass(s, dim, TRANSPORT_XSPH, true, false); }           \
    static void density_##dim(struct sph *s) { pass(s, dim, TRANSPORT_NONE, false, false); }

LAWS(2)
LAWS(3)

scheme_pass *scheme_gradients(int dim, int transport)
{
    static scheme_pass *const passes[2][5] = {{tvs_2, tvo_2, none_2, eulerian_2, xsph_2},
                                              {tvs_3, tvo_3, none_3, eulerian_3, xsph_3}};
    return passes[dim - 2][transport];
}

scheme_pass *scheme_density_gradients(int dim) { return dim == 2 ? density_2 : density_3; }
