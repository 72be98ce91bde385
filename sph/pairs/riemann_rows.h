/* riemann_rows.h - second pass of Riemann SPH over particles of one size, and its instances: with
 * linear Riemann problems in scheme_rates.c, with exact ones in scheme_exact.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_RIEMANN_ROWS_H
#define SPH_RIEMANN_ROWS_H

#include "neighbours.h"
#include "riemann_loops.h"

/* First loop: distances, kernel, and what the Riemann problem needs of the particles themselves. */
INLINE void geometry(const struct riemann_constants *c, const struct riemann_own *i,
                     const double *prim, const double *slope, const int *j, struct riemann_batch *t,
                     const struct riemann_variant v)
{
    const int dim = v.dim;
    for (int k = 0; k < t->n; k++, j += LANES) {
        vec x[3], w, rho, spare, r2;
        if (dim == 3) /* the next loops want them; in 2D they are close by already */
            for (int l = 0; l < LANES; l++) {
                __builtin_prefetch(slope + 16 * (ptrdiff_t)j[l]);
                __builtin_prefetch(slope + 16 * (ptrdiff_t)j[l] + 8);
            }
        vec_columns(prim, PRIM, j, 0, x, x + 1);
        if (dim == 3)
            vec_columns(prim, PRIM, j, 2, x + 2, &spare);
        vec_columns(prim, PRIM, j, at_volume(dim), &w, &rho);
        for (int a = 0; a < dim; a++) {
            x[a] -= i->x[a];
            t->d[a][k] = x[a];
        }
        r2 = vec_dot(x, x, dim) + c->eps2;
        const vec r = vec_sqrt(r2), q = vec_max(1.0 - r * c->R_1, vec_all(0.0));
        t->f[k] = q * q * q * (w * i->w);
        t->rho[k] = rho;
        t->weights[k] = weigh(r, i->Z, impedance(&c->eos, rho, c->gamma));
    }
}

/* Last loop: fluxes, to j as they are, to i with the opposite sign but for volumes. */
INLINE void fluxes(const int *j, const struct riemann_batch *t, double *sums,
                   struct riemann_sums *to, const struct riemann_variant v)
{
    const int dim = v.dim;
    for (int k = 0; k < t->n; k++, j += LANES) {
        const vec Q = t->Q[k], w = t->w[k];
        vec q[3], m = vec_all(0.0);
        for (int a = 0; a < dim; a++)
            q[a] = Q * t->d[a][k]; /* [2.99] */
        if (v.scheme == SCHEME_RIEMANN_ALE) {
            const vec mI = t->m[0][k], mJ = t->m[1][k];
            for (int a = 0; a < dim; a++)
                q[a] += mI * t->u[0][a][k] + mJ * t->u[1][a][k]; /* [2.89] */
            m = mI + mJ;
            to->w += w;
            to->m -= m;
        } else {
            to->w += t->m[0][k];
        }
        if (v.viscosity == VISCOSITY_MORRIS || v.scheme == SCHEME_RIEMANN_ALE)
            for (int a = 0; a < dim; a++)
                q[a] -= t->rub[k] * t->D[a][k];
        for (int a = 0; a < dim; a++)
            to->q[a] -= q[a];
        add_to_neighbours(sums, j, q, w, m, v);
    }
}

/* Row i of the list from the first neighbour beyond i on; all others have added theirs before.
 * Short loops instead of one: chains of dependent operations are short enough then for several
 * vectors to be under way at once. */
INLINE void add_row(const struct sph *s, const struct riemann_constants *c, double *sums, int i,
                    const struct riemann_variant v)
{
    const struct neighbours *l = s->list;
    const int dim = v.dim, nsums = dim == 2 ? 4 : 8;
    const struct riemann_own own = load_own(c, prim_line(&s->p, i), slope_line(&s->p, i), v);
    const int *j = l->j + l->start[i] + l->tail[i];
    struct riemann_sums to = {0};
    for (int left = (l->busy[i] - l->tail[i] + LANES - 1) / LANES; left > 0; left -= BATCH) {
        struct riemann_batch t;
        t.n = left < BATCH ? left : BATCH;
        geometry(c, &own, s->p.prim, s->p.slope, j, &t, v);
        densities(c, &own, s->p.slope, j, &t, v);
        velocities(c, &own, s, j, &t, v);
        solve(c, &own, s, j, &t, v);
        fluxes(j, &t, sums, &to, v);
        j += BATCH * LANES;
    }
    double *row = sums + (ptrdiff_t)nsums * i;
    *(vec4 *)(void *)row +=
        vec_sums(to.q[0], to.q[1], dim == 2 ? to.w : to.q[2], dim == 2 ? to.m : to.w);
    if (dim == 3 && v.scheme == SCHEME_RIEMANN_ALE)
        row[4] += vec_sum(to.m);
}

INLINE void rates(struct sph *s, const struct riemann_variant v)
{
    const struct riemann_constants c = constants_of(s);
    double *sums = neighbours_sums(s, v.dim == 2 ? 4 : 8);
    for (int k = s->list->begin; k < s->list->end; k++)
        add_row(s, &c, sums, neighbours_row(s->list, k), v);
    if (s->list->last)
        write_rates(s, sums, v.dim);
}

/* One instance for every choice: what it leaves out costs nothing. EXACT is the file's. */
#define NAME(dim, scheme, viscosity) rates_##dim##_##scheme##_##viscosity
#define DEFINE(dim, scheme, viscosity)                                                             \
    static void NAME(dim, scheme, viscosity)(struct sph * s)                                       \
    {                                                                                              \
        rates(s, (struct riemann_variant){dim, scheme, viscosity, EXACT});                         \
    }
#define ENTRY(dim, scheme, viscosity) [dim - 2][scheme][viscosity] = NAME(dim, scheme, viscosity),
#define EACH_VISCOSITY(X, ...)                                                                     \
    X(__VA_ARGS__, VISCOSITY_MORRIS)                                                               \
    X(__VA_ARGS__, VISCOSITY_MONAGHAN)                                                             \
    X(__VA_ARGS__, VISCOSITY_OFF)
#define EACH(X)                                                                                    \
    EACH_VISCOSITY(X, 2, SCHEME_RIEMANN_ALE)                                                       \
    EACH_VISCOSITY(X, 2, SCHEME_RIEMANN)                                                           \
    EACH_VISCOSITY(X, 3, SCHEME_RIEMANN_ALE)                                                       \
    EACH_VISCOSITY(X, 3, SCHEME_RIEMANN)

#endif
