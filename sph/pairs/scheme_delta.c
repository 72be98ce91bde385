/* scheme_delta.c - pairs with the sum of both pressures, in one pass (Chiron 2017): `delta'
 * (Antuono) [2.60-2.63] with diffusion of density and linear viscosity, `standard' [2.47-2.50] with
 * artificial viscosity [2.58-2.59]. With grad W at x_i of W(x_i - x_j), volume w, mass m = rho w
 * and momentum q = m u,
 *   dx_i/dt = u0_i,   dm_i/dt = 0
 *   dq_i/dt = m_i g - w_i sum_j w_j (p_i + p_j - Pi_ij) grad W
 *   dw_i/dt = w_i sum_j w_j (u_j - u_i).grad W - (w_i/rho_i) delta c0 R sum_j w_j Psi_ij.grad W
 *   Psi_ij = (2 (rho_j - rho_i) - (grad rho_i + grad rho_j).d) d/d^2,   d = x_j - x_i;
 * of delta Pi_ij = alpha c0 R rho0 (u_j - u_i).d/d^2, of standard it acts on approaching pairs
 * alone; Psi is 0 there. Densities follow volumes, drho = -rho/w dw. Where a transport law moves
 * particles at u0 = u + shift, u and rho are convected along: shift . grad u, shift . grad rho (Sun
 * et al., Comput. Phys. Commun. 224, 2018). Symmetric: row i treats its tail alone, adds to both
 * particles of a pair, and the sums of i are complete once all rows are. Two loops over batches of
 * neighbours (geometry; forces), then write_rates. Called as the second pass of every Runge-Kutta
 * stage, by the table of instances at the end of the file.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scheme.h"

#include "../sph.h"
#include "kernel.h"
#include "kernel_sums.h"
#include "neighbours.h"
#include "riemann.h"
#include "vec.h"

enum { SUMS = 4, VISCOSITY_OFF = 2, BATCH = 8 };

/* What an instance of the pass has fixed; diffusion: the term of delta is there. */
struct delta_variant {
    int dim, scheme, viscosity;
    bool diffusion;
};

/* Numbers of the whole pass. */
struct delta_constants {
    struct tait eos;
    int gamma;
    double R_1, eps2, soft2; /* 1/m; m^2: keeps r > 0; m^2: of [2.59] */
    double kernel;           /* |W'|/r = kernel (1 - r/R)^3 */
    double alpha;            /* delta: alpha c0 R rho0, Pa s; standard: alpha R/8, m */
    double diffusion;        /* delta c0 R, m^2/s */
    double mu;               /* Pa s, times 2 (dim + 2) for Monaghan-Gingold */
};

/* The particle of a row, the same in all lanes. */
struct delta_own {
    vec x[3], u[3], w, rho, p, c, grho[3];
    vec rho_1; /* 1/rho, m^3/kg */
};

/* Vectors of neighbours of one row between the loops that treat them. */
struct delta_batch {
    int n;
    vec d[3][BATCH], f[BATCH]; /* x_j - x_i; w_i w_j |W'|/r */
    vec rho[BATCH], r2[BATCH];
};

/* What the pairs give to their first particle; diffused without the constants of [2.60]. */
struct delta_sums {
    vec q[3], w, diffused;
};

/* Collects what is the same for all pairs of the pass from the state and the parameters. */
static struct delta_constants constants_of(const struct sph *s)
{
    const double R = s->R, mu = kernel_pair_viscosity(s), monaghan = 2.0 * (s->dim + 2.0) * mu;
    const bool delta = s->prm.scheme == SCHEME_DELTA;
    const bool linear = s->nu > 0.0 && s->prm.viscosity == VISCOSITY_MONAGHAN;
    return (struct delta_constants){
        .eos = tait_of(s),
        .gamma = (int)s->gamma,
        .R_1 = 1.0 / R,
        .eps2 = 1e-20 * R * R,
        .soft2 = 1e-4 * R * R,
        .kernel = -kernel_dw_r(s->dim, 0.0, R),
        /* the viscosity of [2.62] has the form of [2.32] and takes it in */
        .alpha = delta ? s->prm.alpha * s->c0 * R * s->rho0 + (linear ? monaghan : 0.0)
                       : 0.125 * s->prm.alpha * R,
        .diffusion = s->prm.delta * s->c0 * R,
        .mu = linear ? monaghan : 2.0 * mu,
    };
}

/* Broadcasts the records of particle i over the lanes, with its pressure and speed of sound. */
INLINE struct delta_own load_own(const struct delta_constants *c, const double *prim,
                                 const double *slope, const struct delta_variant v)
{
    const int dim = v.dim;
    const double rho = prim[at_rho(dim)];
    struct delta_own i;
    for (int a = 0; a < dim; a++) {
        i.x[a] = vec_all(prim[a]);
        i.u[a] = vec_all(prim[dim + a]);
        if (v.diffusion)
            i.grho[a] = vec_all(slope[a]);
    }
    i.w = vec_all(c->kernel * prim[at_volume(dim)]);
    i.rho = vec_all(rho);
    i.p = pressure(&c->eos, i.rho, c->gamma);
    i.c = sound(&c->eos, i.rho, c->gamma);
    i.rho_1 = vec_all(1.0 / rho);
    return i;
}

/* First loop: distances and kernel. d = 0 would give 0/0 further on; eps2 keeps r at 1e-10 R or
 * more. Neighbours beyond R get q = 0, so that listed pairs need no test. */
INLINE void geometry(const struct delta_constants *c, const struct delta_own *i, const double *prim,
                     const double *slope, const int *j, struct delta_batch *t,
                     const struct delta_variant v)
{
    const int dim = v.dim;
    for (int k = 0; k < t->n; k++, j += LANES) {
        vec x[3], w, spare;
        if (v.diffusion && dim == 3) /* the next loop wants them */
            for (int l = 0; l < LANES; l++)
                __builtin_prefetch(slope + 16 * (ptrdiff_t)j[l]);
        vec_columns(prim, PRIM, j, 0, x, x + 1);
        if (dim == 3)
            vec_columns(prim, PRIM, j, 2, x + 2, &spare);
        vec_columns(prim, PRIM, j, at_volume(dim), &w, t->rho + k);
        for (int a = 0; a < dim; a++) {
            x[a] -= i->x[a];
            t->d[a][k] = x[a];
        }
        const vec r2 = vec_dot(x, x, dim) + c->eps2;
        const vec q = vec_max(1.0 - vec_sqrt(r2) * c->R_1, vec_all(0.0));
        t->r2[k] = r2;
        t->f[k] = q * q * q * (w * i->w);
    }
}

/* Velocities of LANES neighbours; in 3D they stand in columns 3 to 5, so that the columns are read
 * in pairs from 2 on. */
INLINE void load_u(const double *prim, const int *j, vec u[3], const int dim)
{
    vec spare;
    if (dim == 2) {
        vec_columns(prim, PRIM, j, 2, u, u + 1);
    } else {
        vec_columns(prim, PRIM, j, 2, &spare, u);
        vec_columns(prim, PRIM, j, 4, u + 1, u + 2);
    }
}

/* What [2.59] or [2.62] take from the sum of pressures; X = (u_j - u_i).(x_j - x_i). r2_1: 1/r^2.
 */
INLINE vec viscous(const struct delta_constants *c, const struct delta_own *i, vec rho, vec X,
                   vec r2, vec r2_1, const struct delta_variant v)
{
    if (v.scheme == SCHEME_DELTA)
        return c->alpha * X * r2_1;
    const vec sum = (i->rho + rho) * (i->c + sound(&c->eos, rho, c->gamma));
    vec Pi = c->alpha * sum * vec_min(X, vec_all(0.0)) / (r2 + c->soft2);
    if (v.viscosity == VISCOSITY_MONAGHAN) /* [2.32] */
        Pi += c->mu * X * r2_1;
    return Pi;
}

/* sum of Psi.grad W [2.61] for i, over w_j; j gets the opposite. */
INLINE vec psi(const struct delta_own *i, const double *slope, const int *j, vec f, vec rho,
               const vec d[3], const int dim)
{
    const int nslope = dim == 2 ? 8 : 16;
    vec g[3], spare;
    vec_columns(slope, nslope, j, 0, g, g + 1);
    if (dim == 3)
        vec_columns(slope, nslope, j, 2, g + 2, &spare);
    for (int a = 0; a < dim; a++)
        g[a] += i->grho[a];
    return f * (2.0 * (rho - i->rho) - vec_dot(g, d, dim));
}

/* Second loop: forces, to j as they are, to i with the opposite sign; volumes. With kernel factor f
 * = w_i w_j |W'|/r, grad W at x_i is +f d/(w_i w_j) up to its sign: W' < 0 and d points to j, so
 * the force on j is along +d where pressures push. */
INLINE void forces(const struct delta_constants *c, const struct delta_own *i, const struct sph *s,
                   const int *j, const struct delta_batch *t, double *sums, struct delta_sums *to,
                   const struct delta_variant v)
{
    const int dim = v.dim;
    for (int k = 0; k < t->n; k++, j += LANES) {
        const vec f = t->f[k], rho = t->rho[k], r2 = t->r2[k];
        vec d[3], D[3], q[3], r2_1 = vec_all(0.0), rho_1 = r2_1;
        load_u(s->p.prim, j, D, dim);
        for (int a = 0; a < dim; a++) {
            d[a] = t->d[a][k];
            D[a] -= i->u[a];
        }
        if (v.scheme == SCHEME_DELTA) { /* one division for both */
            const vec both = 1.0 / (r2 * rho);
            r2_1 = both * rho;
            rho_1 = both * r2;
        } else if (v.viscosity == VISCOSITY_MONAGHAN) {
            r2_1 = 1.0 / r2;
        }
        const vec X = vec_dot(D, d, dim), fX = f * X;
        const vec P = i->p + pressure(&c->eos, rho, c->gamma);
        const vec Q = f * (P - viscous(c, i, rho, X, r2, r2_1, v));
        for (int a = 0; a < dim; a++) {
            q[a] = Q * d[a];
            if (v.viscosity == VISCOSITY_MORRIS) /* [2.31] */
                q[a] -= c->mu * f * D[a];
            to->q[a] -= q[a];
        }
        vec w = fX; /* [2.48], the same for both */
        /* w_i w_j (u_j - u_i).grad W at x_i, whose sign is the same seen from j */
        to->w += w;
        if (v.diffusion) {
            const vec diffused = psi(i, s->p.slope, j, f, rho, d, dim);
            to->diffused += diffused;
            w += c->diffusion * diffused * rho_1;
        }
        vec_add_rows(sums, SUMS, j, q[0], q[1], dim == 3 ? q[2] : w, dim == 3 ? w : vec_all(0.0));
    }
}

/* Row i of the list from the first neighbour beyond i on. What padded lanes add goes to the dummy's
 * record. */
INLINE void add_row(const struct sph *s, const struct delta_constants *c, double *sums, int i,
                    const struct delta_variant v)
{
    const struct neighbours *l = s->list;
    const int dim = v.dim;
    const struct delta_own own = load_own(c, prim_line(&s->p, i), slope_line(&s->p, i), v);
    const int *j = l->j + l->start[i] + l->tail[i];
    struct delta_sums to = {0};
    for (int left = (l->busy[i] - l->tail[i] + LANES - 1) / LANES; left > 0; left -= BATCH) {
        struct delta_batch t;
        t.n = left < BATCH ? left : BATCH;
        geometry(c, &own, s->p.prim, s->p.slope, j, &t, v);
        forces(c, &own, s, j, &t, sums, &to, v);
        j += BATCH * LANES;
    }
    if (v.diffusion)
        to.w -= c->diffusion * to.diffused * own.rho_1;
    *(vec4 *)(void *)(sums + (ptrdiff_t)SUMS * i) +=
        vec_sums(to.q[0], to.q[1], dim == 3 ? to.q[2] : to.w, dim == 3 ? to.w : vec_all(0.0));
}

/* Without a first pass u0 = u, which others read from the slopes. */
INLINE void move(struct sph *s, int i, double *rate, const int dim)
{
    const double *u = prim_line(&s->p, i) + dim;
    double *u0 = slope_line(&s->p, i) + dim + dim * dim;
    for (int a = 0; a < dim; a++) {
        if (!s->scheme->gradients)
            u0[a] = u[a];
        rate[a] = u0[a];
    }
}

/* Adds what a particle convects that moves at u0 instead of u: momentum rho w (u0 - u).grad u and
 * volume -(w/rho) (u0 - u).grad rho. */
INLINE void take_along(const struct sph *s, int i, double *rate, const int dim)
{
    const double *prim = prim_line(&s->p, i), *u = prim + dim;
    const double *grho = slope_line(&s->p, i), *gu = grho + dim;
    const double *u0 = gu + dim * dim, w = prim[at_volume(dim)], rho = prim[at_rho(dim)];
    for (int b = 0; b < dim; b++) {
        const double shift = u0[b] - u[b];
        for (int a = 0; a < dim; a++)
            rate[dim + a] += rho * w * shift * gu[dim * a + b];
        rate[at_volume(dim)] -= w / rho * shift * grho[b];
    }
}

void scheme_take_along(const struct sph *s, int i, double *rate) { take_along(s, i, rate, s->dim); }

/* From the last row on: rows of the sums stand where those of rates will, which are longer. */
INLINE void write_rates(struct sph *s, const double *sums, const int dim)
{
    const int transport = s->prm.transport;
    for (int i = s->p.n - 1; i >= 0; i--) {
        double row[SUMS];
        memcpy(row, sums + (ptrdiff_t)SUMS * i, sizeof row);
        const double *y = state_row(&s->p, s->p.y, i);
        double *rate = state_row(&s->p, s->p.rate, i);
        move(s, i, rate, dim);
        for (int a = 0; a < dim; a++)
            rate[dim + a] = row[a] + y[at_mass(dim)] * s->gravity[a];
        rate[at_volume(dim)] = row[dim];
        rate[at_mass(dim)] = 0.0;
        if (transport == TRANSPORT_TVS || transport == TRANSPORT_TVO)
            take_along(s, i, rate, dim);
    }
}

/* One body for all instances: v is constant in each, so the compiler drops what a variant does not
 * have. */
INLINE void rates(struct sph *s, const struct delta_variant v)
{
    const struct delta_constants c = constants_of(s);
    double *sums = neighbours_sums(s, SUMS);
    for (int k = s->list->begin; k < s->list->end; k++)
        add_row(s, &c, sums, neighbours_row(s->list, k), v);
    if (s->list->last)
        write_rates(s, sums, v.dim);
}

#define NAME(dim, kind, viscosity) rates_##dim##_##kind##_##viscosity
#define DEFINE(dim, kind, scheme, diffusion, viscosity)                                            \
    static void NAME(dim, kind, viscosity)(struct sph * s)                                         \
    {                                                                                              \
        rates(s, (struct delta_variant){dim, scheme, viscosity, diffusion});                       \
    }
#define ENTRY(dim, kind, scheme, diffusion, viscosity)                                             \
    [dim - 2][KIND_##kind][viscosity] = NAME(dim, kind, viscosity),
#define EACH_VISCOSITY(X, ...)                                                                     \
    X(__VA_ARGS__, VISCOSITY_MORRIS)                                                               \
    X(__VA_ARGS__, VISCOSITY_MONAGHAN)                                                             \
    X(__VA_ARGS__, VISCOSITY_OFF)
#define EACH_KIND(X, dim)                                                                          \
    EACH_VISCOSITY(X, dim, DELTA, SCHEME_DELTA, true)                                              \
    EACH_VISCOSITY(X, dim, UNDIFFUSED, SCHEME_DELTA, false)                                        \
    EACH_VISCOSITY(X, dim, STANDARD, SCHEME_STANDARD, false)
enum { KIND_DELTA, KIND_UNDIFFUSED, KIND_STANDARD };

EACH_KIND(DEFINE, 2)
EACH_KIND(DEFINE, 3)

scheme_pass *scheme_delta_rates(const struct sph *s)
{
    static scheme_pass *const passes[2][3][3] = {EACH_KIND(ENTRY, 2) EACH_KIND(ENTRY, 3)};
    const int viscosity = s->nu > 0.0 ? s->prm.viscosity : VISCOSITY_OFF;
    const int kind = s->prm.scheme == SCHEME_STANDARD ? KIND_STANDARD
                     : s->prm.delta > 0.0             ? KIND_DELTA
                                                      : KIND_UNDIFFUSED;
    return passes[s->dim - 2][kind][viscosity];
}
