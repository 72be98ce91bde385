/* mixed_pairs.c - both passes over the pairs of particles of different sizes, in 2D: as
 * scheme_gradients.c and riemann_rows.h, but with the mean R of each pair and with weights of the
 * sources [5.12-5.13], which lie where lines have pressure and speed of sound. Columns 6 and 7 of a
 * packed record hold weight and R here; mixed_gradients writes them before every first pass, so
 * pressure and speed of sound must be computed from rho instead.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mixed.h"

#include "../pairs/riemann_loops.h"
#include "../pairs/sph_pairs.h"
#include "../surface/sph_surface.h"

enum { LINE_WEIGHT = 6, LINE_R = 7 };

static const double slope_of_kernel = 20.0 * 7.0 / M_PI;   /* |W'|/r = this t^3/R^4, t = 1 - r/R */
static const double least_trust = 0.1, enough_trust = 0.2; /* as in scheme_gradients.c */
static const double at_surface = 0.75; /* eigenvalue below which a support has an open side */

/* Of all lines, ghosts too. */
static void write_sizes(struct sph *s)
{
    for (int i = 0; i < s->p.n + s->p.nghost; i++) {
        prim_line(&s->p, i)[LINE_WEIGHT] = *mixed_weight(s, i);
        prim_line(&s->p, i)[LINE_R] = *mixed_R(s, i);
    }
    prim_line(&s->p, s->p.capacity)[LINE_WEIGHT] = 0.0;
    prim_line(&s->p, s->p.capacity)[LINE_R] = s->mixed ? mixed_least(s) : 1.0;
}

/* --- first pass --- */

/* Sums over neighbours without the kernel's constant. */
struct mixed_moments {
    vec M[3], rho[2], u[2][2], n[2];
};

/* Adds the neighbours of one particle to the moments: gradients with the mean R of each pair, the
 * crowding vector with the particle's own R. */
INLINE void add_moments(const double *prim, const double *own, const int *j, int count,
                        double Wdx_1, struct mixed_moments *to)
{
    const double eps2 = 1e-20 * own[LINE_R] * own[LINE_R], Ri_1 = 1.0 / own[LINE_R];
    for (const int *end = j + count; j < end; j += LANES) {
        vec d[2], u[2], w, rho, chi, R;
        vec_columns(prim, PRIM, j, 0, d, d + 1);
        vec_columns(prim, PRIM, j, 2, u, u + 1);
        vec_columns(prim, PRIM, j, 4, &w, &rho);
        vec_columns(prim, PRIM, j, LINE_WEIGHT, &chi, &R);
        for (int a = 0; a < 2; a++) {
            d[a] -= own[a];
            u[a] -= own[2 + a];
        }
        rho -= own[5];
        w *= chi;
        const vec r = vec_sqrt(vec_dot(d, d, 2) + eps2), R_1 = 2.0 / (R + own[LINE_R]);
        const vec t = vec_max(1.0 - r * R_1, vec_all(0.0)), R2 = R_1 * R_1;
        const vec g = t * t * t * (R2 * R2) * w;
        for (int b = 0, m = 0; b < 2; b++) {
            const vec gd = g * d[b];
            to->rho[b] += rho * gd;
            for (int a = 0; a < 2; a++)
                to->u[a][b] += u[a] * gd;
            for (int a = 0; a <= b; a++)
                to->M[m++] += d[a] * gd;
        }
        /* crowding in the particle's own support, where an even set has none */
        const vec q = vec_max(1.0 - r * Ri_1, vec_all(0.0)), q2 = q * q, q3 = q2 * q;
        const vec W = q2 * q2 * (5.0 - 4.0 * q) * Wdx_1, W2 = W * W;
        const vec weight = (q3 + 0.2 * q3 * (W2 * W2)) * w;
        for (int a = 0; a < 2; a++)
            to->n[a] += weight * d[a];
    }
}

/* Of the symmetric matrix M00, M01, M11. */
static double smallest_eigenvalue(const double *M)
{
    const double mean = 0.5 * (M[0] + M[2]), half = 0.5 * (M[0] - M[2]);
    return mean - sqrt(half * half + M[1] * M[1]);
}

/* u0 - u: -2 U R times the crowding vector, U/4 at most. */
static void shift(const struct sph *s, int i, const double *n, double R, double *delta)
{
    const double U = scheme_shift_speed(s, i), factor = -2.0 * U * slope_of_kernel / (R * R * R);
    double size2 = 0.0;
    for (int a = 0; a < 2; a++) {
        delta[a] = factor * n[a];
        size2 += delta[a] * delta[a];
    }
    if (size2 > 0.0625 * U * U && !s->walls && !s->surface)
        for (int a = 0; a < 2; a++)
            delta[a] *= 0.25 * U / sqrt(size2);
}

/* Writes renormalised gradients and u0 to the slope record, and the surface's class by the
 * eigenvalue alone. */
static void write_slopes(struct sph *s, int i, const struct mixed_moments *sum)
{
    const double *own = prim_line(&s->p, i), R = own[LINE_R];
    double M[3], delta[2] = {0.0, 0.0}, *slope = slope_line(&s->p, i);
    for (int k = 0; k < 3; k++)
        M[k] = slope_of_kernel * vec_sum(sum->M[k]);
    const double lambda = smallest_eigenvalue(M), det = M[0] * M[2] - M[1] * M[1];
    const double share =
        fmax(0.0, fmin((lambda - least_trust) / (enough_trust - least_trust), 1.0));
    const double f = share > 0.0 ? slope_of_kernel * share / det : 0.0;
    const double B[2][2] = {{f * M[2], -f * M[1]}, {-f * M[1], f * M[0]}};
    for (int b = 0; b < 2; b++) {
        slope[b] = vec_sum(sum->rho[0]) * B[0][b] + vec_sum(sum->rho[1]) * B[1][b];
        for (int a = 0; a < 2; a++)
            slope[2 + 2 * a + b] =
                vec_sum(sum->u[a][0]) * B[0][b] + vec_sum(sum->u[a][1]) * B[1][b];
    }
    if (s->prm.transport == TRANSPORT_TVS) {
        const double n[2] = {vec_sum(sum->n[0]), vec_sum(sum->n[1])};
        shift(s, i, n, R, delta);
    }
    for (int a = 0; a < 2; a++)
        slope[6 + a] = own[2 + a] + delta[a];
    if (s->surface) { /* no search in a cone here: what lacks neighbours is on the surface */
        s->surface->is[i] = lambda < at_surface ? SURFACE_ON : SURFACE_INNER;
        s->surface->lambda[i] = lambda;
        memset(s->surface->normal + 2 * (size_t)i, 0, 2 * sizeof(double));
    }
}

/* W/W(dx) depends on R/dx alone, which all particles share; Wdx_1 is its constant. */
void mixed_gradients(struct sph *s)
{
    const struct neighbours *l = s->list;
    const double dx = 1.0 / s->prm.R_dx, t = 1.0 - dx;
    const double Wdx_1 = 1.0 / (t * t * t * t * (1.0 + 4.0 * dx));
    write_sizes(s);
    for (int i = l->begin; i < l->end; i++) {
        struct mixed_moments sum = {0};
        add_moments(s->p.prim, prim_line(&s->p, i), l->j + l->start[i], l->count[i], Wdx_1, &sum);
        write_slopes(s, i, &sum);
    }
    if (s->surface)
        s->surface->known = true;
}

/* --- second pass --- */

/* Of a batch beside what batch has: mean R, weight of j. */
struct mixed_batch {
    vec R[BATCH], weight[BATCH];
};

/* As in riemann_rows.h, but with R of each pair: |W'|/r = slope_of_kernel (1 - r/R)^3/R^4, which
 * needs a division per vector. */
INLINE void geometry(const struct riemann_constants *c, const struct riemann_own *i, double Ri,
                     const double *prim, const int *j, struct riemann_batch *t,
                     struct mixed_batch *m)
{
    for (int k = 0; k < t->n; k++, j += LANES) {
        vec d[2], w, rho, R;
        vec_columns(prim, PRIM, j, 0, d, d + 1);
        vec_columns(prim, PRIM, j, 4, &w, &rho);
        vec_columns(prim, PRIM, j, LINE_WEIGHT, m->weight + k, &R);
        for (int a = 0; a < 2; a++) {
            d[a] -= i->x[a];
            t->d[a][k] = d[a];
        }
        m->R[k] = 0.5 * (R + Ri);
        const vec R_1 = 1.0 / m->R[k], R2 = R_1 * R_1;
        const vec r = vec_sqrt(vec_dot(d, d, 2) + 1e-20 * Ri * Ri);
        const vec q = vec_max(1.0 - r * R_1, vec_all(0.0));
        t->f[k] = q * q * q * (R2 * R2) * (w * i->w);
        t->rho[k] = rho;
        t->weights[k] = weigh(r, i->Z, impedance(&c->eos, rho, c->gamma));
    }
}

/* The acoustic damper, as wide as the pair: beta rho0 c0 R div u is taken from either pressure.
 * constants_of would take the coarsest R for all, so its damper is off. */
INLINE void damp(const double *slope, const double *own, const int *j, double beta,
                 struct riemann_batch *t, const struct mixed_batch *m)
{
    const double mine = own[2] + own[5];
    for (int k = 0; k < t->n; k++, j += LANES) {
        vec gu[3][3];
        load_gu(slope, j, gu, 2);
        t->p[0][k] -= beta * mine * m->R[k];
        t->p[1][k] -= beta * m->R[k] * (gu[0][0] + gu[1][1]);
    }
}

/* To j with the weight of i, to i with that of j. With unequal weights pairs are not symmetric: the
 * method conserves momentum only where weights are equal. */
INLINE void fluxes(const int *j, const struct riemann_batch *t, const struct mixed_batch *m,
                   double chi, double *sums, struct riemann_sums *to,
                   const struct riemann_variant v)
{
    for (int k = 0; k < t->n; k++, j += LANES) {
        const vec weight = m->weight[k];
        vec q[2], mass = vec_all(0.0);
        for (int a = 0; a < 2; a++)
            q[a] = t->Q[k] * t->d[a][k];
        if (v.scheme == SCHEME_RIEMANN_ALE) {
            for (int a = 0; a < 2; a++)
                q[a] += t->m[0][k] * t->u[0][a][k] + t->m[1][k] * t->u[1][a][k];
            mass = t->m[0][k] + t->m[1][k];
            to->w += weight * t->w[k];
            to->m -= weight * mass;
        } else {
            to->w += weight * t->m[0][k];
        }
        for (int a = 0; a < 2; a++) {
            q[a] -= t->rub[k] * t->D[a][k];
            to->q[a] -= weight * q[a];
        }
        vec_add_rows(sums, 4, j, chi * q[0], chi * q[1], chi * t->w[k], chi * mass);
    }
}

/* Row i of the list from the first neighbour beyond i on, as in riemann_rows.h. */
INLINE void add_row(const struct sph *s, const struct riemann_constants *c, double beta,
                    double *sums, int i, const struct riemann_variant v)
{
    const struct neighbours *l = s->list;
    const double *prim = prim_line(&s->p, i), *slope = slope_line(&s->p, i);
    const struct riemann_own own = load_own(c, prim, slope, v);
    const int *j = l->j + l->start[i] + l->tail[i];
    struct riemann_sums to = {0};
    for (int left = (l->count[i] - l->tail[i] + LANES - 1) / LANES; left > 0; left -= BATCH) {
        struct riemann_batch t;
        struct mixed_batch m;
        t.n = left < BATCH ? left : BATCH;
        geometry(c, &own, prim[LINE_R], s->p.prim, j, &t, &m);
        densities(c, &own, s->p.slope, j, &t, v);
        velocities(c, &own, s, j, &t, v);
        if (beta > 0.0)
            damp(s->p.slope, slope, j, beta, &t, &m);
        solve(c, &own, s, j, &t, v);
        fluxes(j, &t, &m, prim[LINE_WEIGHT], sums, &to, v);
        j += BATCH * LANES;
    }
    *(vec4 *)(void *)(sums + 4 * (ptrdiff_t)i) += vec_sums(to.q[0], to.q[1], to.w, to.m);
}

INLINE void rates(struct sph *s, const struct riemann_variant v)
{
    struct riemann_constants c = constants_of(s);
    const double beta = s->prm.damper * s->rho0 * s->c0;
    double *sums = neighbours_sums(s, 4);
    c.kernel = 2.0 * slope_of_kernel;
    c.damper = 0.0;
    for (int i = s->list->begin; i < s->list->end; i++)
        add_row(s, &c, beta, sums, i, v);
    if (s->list->last)
        write_rates(s, sums, 2);
}

#define RATES(scheme, viscosity)                                                                   \
    static void rates_##scheme##_##viscosity(struct sph *s)                                        \
    {                                                                                              \
        rates(s, (struct riemann_variant){2, scheme, viscosity, false});                           \
    }
RATES(SCHEME_RIEMANN_ALE, VISCOSITY_MORRIS)
RATES(SCHEME_RIEMANN_ALE, VISCOSITY_MONAGHAN)
RATES(SCHEME_RIEMANN_ALE, VISCOSITY_OFF)
RATES(SCHEME_RIEMANN, VISCOSITY_MORRIS)
RATES(SCHEME_RIEMANN, VISCOSITY_MONAGHAN)
RATES(SCHEME_RIEMANN, VISCOSITY_OFF)

/* One pass for each scheme and viscous term, so that none asks within its loops. */
void mixed_rates(struct sph *s)
{
    static void (*const passes[2][3])(struct sph *) = {
        {rates_SCHEME_RIEMANN_ALE_VISCOSITY_MORRIS, rates_SCHEME_RIEMANN_ALE_VISCOSITY_MONAGHAN,
         rates_SCHEME_RIEMANN_ALE_VISCOSITY_OFF},
        {rates_SCHEME_RIEMANN_VISCOSITY_MORRIS, rates_SCHEME_RIEMANN_VISCOSITY_MONAGHAN,
         rates_SCHEME_RIEMANN_VISCOSITY_OFF}};
    passes[s->prm.scheme][s->nu > 0.0 ? s->prm.viscosity : VISCOSITY_OFF](s);
}
