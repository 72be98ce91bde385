/* scheme_rates.c - second pass: Riemann fluxes of every pair once, added to both partners.
 *   riemann_ale  Vila's ALE form [2.86-2.89]: fluxes of mass and momentum through the middle of the
 * pair, which moves with u0; w follows div u0 riemann      Leduc's form [2.96-2.99]: the middle
 * moves with u_E, no mass flux States by limited reconstruction (riemann.h). rho_E is taken from
 * P_E along the isentrope of the mean state, rho + (P_E - P)/c^2, which errs by the square of a
 * jump. The acoustic damper adds -beta rho0 c0 R div u to each particle's pressure.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scheme.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "kernel.h"
#include "neighbours.h"
#include "riemann.h"
#include "vec.h"

enum { PRIM = 8, SLOPE_MAX = 16, SUM_MAX = 8 };

struct pass {
    double R2, per_R, slope; /* slope = 20 W0/R^2 */
    double rho0, per_rho0, B, c0, per_c0, per_c02, gamma;
    double damper; /* beta rho0 c0 R */
    double mu;     /* 2 mu (Morris), 2 (D+2) mu (Monaghan-Gingold), halved: areas carry the 2 */
    int limiter;
    bool low;
};

/* One particle against four: what i and its four partners need. */
struct side {
    vec x[3], u[3], w, rho, slope[SLOPE_MAX];
};

static inline __attribute__((always_inline)) void unpack(const vec *p, const vec *g, struct side *q,
                                                         const int dim)
{
    for (int a = 0; a < dim; a++) {
        q->x[a] = p[a];
        q->u[a] = p[dim + a];
    }
    q->w = p[2 * dim];
    q->rho = p[2 * dim + 1];
    for (int k = 0; k < dim + dim * dim + dim; k++)
        q->slope[k] = g[k];
}

/* P, c of a reconstructed density. */
static inline __attribute__((always_inline)) void state_of(const struct pass *c, vec rho,
                                                           const bool stiff, vec *P, vec *sound)
{
    if (stiff || c->gamma == 7.0) {
        tait7(rho * c->per_rho0, c->B, c->c0, P, sound);
    } else {
        *P = c->c0 * c->c0 * (rho - c->rho0);
        *sound = vec_all(c->c0);
    }
}

static inline __attribute__((always_inline)) vec dot(const vec *a, const vec *b, const int dim)
{
    vec s = a[0] * b[0] + a[1] * b[1];
    return dim == 3 ? s + a[2] * b[2] : s;
}

/* Rates of i and of its partners j: sum[0..dim-1] momentum, [dim] volume, [dim+1] mass, of i and j.
 */
static inline __attribute__((always_inline)) void pair(const struct pass *c, const struct side *i,
                                                       const struct side *j, vec *to_i, vec *to_j,
                                                       const int dim, const int scheme,
                                                       const int viscosity, const int limiter,
                                                       const bool low, const bool stiff)
{
    const vec zero = {0.0, 0.0, 0.0, 0.0};
    vec d[3], n[3], ul[3], ur[3], r2 = vec_all(1e-12 * c->R2);
    for (int a = 0; a < dim; a++) {
        d[a] = j->x[a] - i->x[a];
        r2 += d[a] * d[a];
    }
    const vec r = vec_sqrt(r2), t = vec_max(1.0 - r * c->per_R, zero);
    const vec g = c->slope * t * t * t * i->w * j->w; /* w_i w_j |W'|/r */

    /* states on both sides of the middle */
    const vec Dr = j->rho - i->rho;
    const vec rl = i->rho + half_step(Dr, dot(i->slope, d, dim), limiter);
    const vec rr = j->rho - half_step(Dr, dot(j->slope, d, dim), limiter);
    for (int a = 0; a < dim; a++) {
        const vec D = j->u[a] - i->u[a];
        ul[a] = i->u[a] + half_step(D, dot(i->slope + dim * (a + 1), d, dim), limiter);
        ur[a] = j->u[a] - half_step(D, dot(j->slope + dim * (a + 1), d, dim), limiter);
    }
    vec Pl, Pr, cl, cr, divi = zero, divj = zero;
    state_of(c, rl, stiff, &Pl, &cl);
    state_of(c, rr, stiff, &Pr, &cr);
    for (int a = 0; a < dim; a++) {
        divi += i->slope[dim * (a + 1) + a];
        divj += j->slope[dim * (a + 1) + a];
    }
    Pl -= c->damper * divi;
    Pr -= c->damper * divj;

    /* one division serves 1/r and 1/(Zl + Zr) */
    const vec Zl = rl * cl, Zr = rr * cr, Z = Zl + Zr, both = 1.0 / (r * Z), per_r = both * Z;
    vec uE, PE;
    for (int a = 0; a < dim; a++)
        n[a] = d[a] * per_r;
    const vec unl = dot(ul, n, dim), unr = dot(ur, n, dim);
    riemann(Zl, unl, Pl, Zr, unr, Pr, both * r, low, c->per_c0, &uE, &PE);

    const vec area = g * r, area2 = 2.0 * area; /* w_i w_j |W'| */
    const vec *u0i = i->slope + dim + dim * dim, *u0j = j->slope + dim + dim * dim;
    vec push = area2 * PE, viscous = zero;
    if (viscosity == 1) /* Morris [2.31] */
        viscous = 2.0 * c->mu * g;
    vec along = zero;
    if (viscosity == 2) /* Monaghan-Gingold [2.32] */
        along = 2.0 * c->mu * g * (dot(j->u, n, dim) - dot(i->u, n, dim));
    if (scheme == SCHEME_RIEMANN_ALE) {
        vec u0[3], du0[3];
        for (int a = 0; a < dim; a++) {
            u0[a] = 0.5 * (u0i[a] + u0j[a]);
            du0[a] = u0j[a] - u0i[a];
        }
        const vec rel = uE - dot(u0, n, dim);
        const vec rhoE = 0.5 * (rl + rr) + (PE - 0.5 * (Pl + Pr)) * c->per_c02;
        const vec flux = area2 * rhoE * rel;
        const mask from_i = rel > zero;
        const vec kick = uE - vec_pick(from_i, unl, unr); /* tangential part of the upwind side */
        for (int a = 0; a < dim; a++) {
            vec f = flux * (vec_pick(from_i, ul[a], ur[a]) + kick * n[a]) + push * n[a];
            if (viscosity)
                f -= viscous * (j->u[a] - i->u[a]) + along * n[a];
            to_i[a] = -f;
            to_j[a] = f;
        }
        to_i[dim] = to_j[dim] = area * dot(du0, n, dim);
        to_i[dim + 1] = -flux;
        to_j[dim + 1] = flux;
    } else {
        for (int a = 0; a < dim; a++) {
            vec f = push * n[a];
            if (viscosity)
                f -= viscous * (j->u[a] - i->u[a]) + along * n[a];
            to_i[a] = -f;
            to_j[a] = f;
        }
        to_i[dim] = area2 * (uE - dot(i->u, n, dim));
        to_j[dim] = area2 * (dot(j->u, n, dim) - uE);
        to_i[dim + 1] = to_j[dim + 1] = zero;
    }
}

/* Adds columns of four partners to their rows. A dummy may stand more than once: its row is never
 * read. */
static inline __attribute__((always_inline)) void scatter(double *sums, const int *j, vec *to_j,
                                                          const int dim)
{
    const int width = dim == 2 ? 4 : 8;
    vec_transpose(to_j, to_j + 1, to_j + 2, to_j + 3);
    for (int k = 0; k < LANES; k++) {
        double *row = sums + (size_t)j[k] * (size_t)width;
        vec_store(row, vec_load(row) + to_j[k]);
        if (dim == 3)
            row[4] += to_j[4][k];
    }
}

/* Sums of the row of i over its partners behind it. */
static inline __attribute__((always_inline)) void
row(struct sph *s, const struct pass *c, double *sums, int i, const int dim, const int scheme,
    const int viscosity, const int limiter, const bool low, const bool stiff)
{
    const struct neighbours *l = s->list;
    const int nslope = dim == 2 ? 8 : 16, width = dim == 2 ? 4 : 8;
    const int *j = l->j + l->start[i];
    vec p[PRIM], g[SLOPE_MAX], mine[SUM_MAX] = {{0}};
    struct side one, four;
    for (int k = 0; k < PRIM; k++)
        p[k] = vec_all(s->p.prim[(size_t)PRIM * i + k]);
    for (int k = 0; k < nslope; k++)
        g[k] = vec_all(s->p.slope[(size_t)nslope * i + k]);
    unpack(p, g, &one, dim);
    for (int k = l->tail[i]; k < l->count[i]; k += LANES) {
        vec to_i[SUM_MAX], to_j[SUM_MAX];
        vec_columns(s->p.prim, PRIM, j + k, PRIM, p);
        vec_columns(s->p.slope, nslope, j + k, nslope, g);
        unpack(p, g, &four, dim);
        pair(c, &one, &four, to_i, to_j, dim, scheme, viscosity, limiter, low, stiff);
        for (int m = 0; m < dim + 2; m++)
            mine[m] += to_i[m];
        scatter(sums, j + k, to_j, dim);
    }
    for (int m = 0; m < dim + 2; m++)
        sums[(size_t)i * width + m] += vec_sum(mine[m]);
}

static struct pass constants(const struct sph *s)
{
    const double per_c0 = 1.0 / s->c0, mu = s->rho0 * s->nu;
    return (struct pass){.R2 = s->R * s->R,
                         .per_R = 1.0 / s->R,
                         .slope = 20.0 * kernel_w0(s->dim, s->R) / (s->R * s->R),
                         .rho0 = s->rho0,
                         .per_rho0 = 1.0 / s->rho0,
                         .B = s->rho0 * s->c0 * s->c0 / 7.0,
                         .c0 = s->c0,
                         .per_c0 = per_c0,
                         .per_c02 = per_c0 * per_c0,
                         .gamma = s->gamma,
                         .damper = s->prm.damper * s->rho0 * s->c0 * s->R,
                         .mu = s->prm.viscosity == VISCOSITY_MORRIS ? mu : (s->dim + 2) * mu,
                         .limiter = s->prm.limiter,
                         .low = s->prm.low_dissipation};
}

/* Zeroed sums of locals, ghosts and the dummy. */
static double *clear_sums(struct sph *s, int width)
{
    struct neighbours *l = s->list;
    const int64_t n = (int64_t)(s->p.capacity + 1) * width;
    if (n > l->sums_capacity) {
        mem_free(l->sums);
        l->sums = NEW(double, n);
        l->sums_capacity = n;
    }
    memset(l->sums, 0, (size_t)(s->p.n + s->p.nghost) * (size_t)width * sizeof(double));
    memset(l->sums + (size_t)s->p.capacity * (size_t)width, 0, (size_t)width * sizeof(double));
    return l->sums;
}

/* Rows of sums to rates: x moves with u0, gravity acts on the mass. */
static void spread(struct sph *s, const double *sums, int width)
{
    const int dim = s->dim, nstate = s->p.nstate;
    for (int i = 0; i < s->p.n; i++) {
        double *rate = s->p.rate + (size_t)i * nstate;
        const double *u0 = s->p.slope + (size_t)i * s->p.nslope + dim + dim * dim;
        const double *sum = sums + (size_t)i * width, m = s->p.y[(size_t)i * nstate + 2 * dim + 1];
        for (int a = 0; a < dim; a++) {
            rate[a] = u0[a];
            rate[dim + a] = sum[a] + m * s->gravity[a];
        }
        rate[2 * dim] = sum[dim];
        rate[2 * dim + 1] = sum[dim + 1];
    }
}

static inline __attribute__((always_inline)) void
rates(struct sph *s, const int dim, const int scheme, const int viscosity, const bool plain)
{
    const struct pass c = constants(s);
    const int width = dim == 2 ? 4 : 8;
    double *sums = clear_sums(s, width);
    for (int i = 0; i < s->list->n; i++) {
        if (plain) /* the default states: all constants */
            row(s, &c, sums, i, dim, scheme, viscosity, LIMITER_KOREN, true, true);
        else
            row(s, &c, sums, i, dim, scheme, viscosity, c.limiter, c.low, false);
    }
    spread(s, sums, width);
}

/* clang-format off */
#define RATES(dim, scheme, viscosity)                                                              \
    static void rates_##dim##_##scheme##_##viscosity(struct sph *s)                                \
    {                                                                                              \
        rates(s, dim, scheme, viscosity, false);                                                   \
    }                                                                                              \
    static void plain_##dim##_##scheme##_##viscosity(struct sph *s)                                \
    {                                                                                              \
        rates(s, dim, scheme, viscosity, true);                                                    \
    }
#define ALL(F)                                                                                     \
    F(2, 0, 0)                                                                                     \
    F(2, 0, 1) F(2, 0, 2) F(2, 1, 0) F(2, 1, 1) F(2, 1, 2) F(3, 0, 0) F(3, 0, 1) F(3, 0, 2)        \
        F(3, 1, 0) F(3, 1, 1) F(3, 1, 2)
ALL(RATES)

#define ENTRY(dim, scheme, viscosity)                                                              \
    [dim - 2][scheme][viscosity] = {rates_##dim##_##scheme##_##viscosity,                          \
                                    plain_##dim##_##scheme##_##viscosity},
/* clang-format on */

scheme_pass *scheme_rates(const struct sph *s)
{
    static scheme_pass *const pass[2][2][3][2] = {ALL(ENTRY)};
    const int viscosity = s->nu > 0.0 ? (s->prm.viscosity == VISCOSITY_MORRIS ? 1 : 2) : 0;
    const bool plain = s->prm.limiter == LIMITER_KOREN && s->prm.low_dissipation && s->gamma == 7.0;
    return pass[s->dim - 2][s->prm.scheme][viscosity][plain];
}

struct scheme scheme_pick(const struct sph *s)
{
    static const char *const names[] = {"riemann_ale", "riemann"};
    return (struct scheme){.name = names[s->prm.scheme],
                           .gradients = scheme_gradients(s->dim, s->prm.transport),
                           .rates = scheme_rates(s)};
}
