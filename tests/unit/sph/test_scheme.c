/* test_scheme.c - the pair passes against a double loop written from the equations, and against the
 * laws they must keep. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/kernel.h"
#include "../../../sph/pairs/kernel_sums.h"
#include "../../../sph/particles/eos.h"
#include "sph_toy.h"

enum { OFF = 2 };

/* d = x_j - x_i; returns r. */
static double between(const struct sph *s, int i, int j, double *d)
{
    for (int a = 0; a < s->dim; a++)
        d[a] = prim_of(s, j)[a] - prim_of(s, i)[a];
    return sqrt(dot(d, d, s->dim));
}

/* [2.82-2.83] and Koren's third-order step in printed form, its bounds wider by slack. */
static double step(double D, double slope, int limiter, double slack)
{
    if (limiter == LIMITER_NONE)
        return (2.0 * slope + D) / 6.0;
    if (limiter == LIMITER_MINMOD)
        return D == 0.0 ? 0.0 : 0.5 * D * fmax(0.0, fmin(1.0, slope / D));
    const double sign = D < 0.0 ? -1.0 : 1.0, before = sign * (2.0 * slope - D), ahead = fabs(D);
    const double third = (before + 2.0 * ahead) / 6.0;
    return sign * fmax(-slack, fmin(third, fmax(0.0, fmin(before, ahead)) + slack));
}

/* One side of a pair: particle, its state at the middle. */
struct side {
    double rho, u[3], p, Z, u0[3];
};

/* State of particle i on the way to j, d = x_j - x_i. */
static struct side side_of(const struct sph *s, int i, int j, const double *d)
{
    const int dim = s->dim;
    const double *q = prim_of(s, i), *o = prim_of(s, j), *g = slope_of(s, i);
    struct side e;
    double divergence = 0.0;
    e.rho = q[2 * dim + 1] +
            step(o[2 * dim + 1] - q[2 * dim + 1], dot(g, d, dim), s->prm.limiter, 0.002 * s->rho0);
    for (int a = 0; a < dim; a++) {
        const double *gu = g + dim + dim * a;
        e.u[a] = q[dim + a] +
                 step(o[dim + a] - q[dim + a], dot(gu, d, dim), s->prm.limiter, 0.02 * s->c0);
        e.u0[a] = g[dim + dim * dim + a];
        divergence += gu[a];
    }
    e.p = eos_p(e.rho, s->rho0, s->c0, s->gamma) -
          s->prm.damper * s->rho0 * s->c0 * s->R * divergence;
    e.Z = q[2 * dim + 1] * eos_c(q[2 * dim + 1], s->rho0, s->c0, s->gamma);
    return e;
}

/* u_j - u_i of the viscous term: Morris's takes 4/3 of it and 1/3 of what the gradients make of it.
 */
static double parting(const struct sph *s, int i, int j, const double *d, int a)
{
    const int dim = s->dim;
    const double D = prim_of(s, j)[dim + a] - prim_of(s, i)[dim + a];
    const double slopes =
        dot(slope_of(s, i) + dim + dim * a, d, dim) + dot(slope_of(s, j) + dim + dim * a, d, dim);
    return s->nu > 0.0 && s->prm.viscosity == VISCOSITY_MORRIS ? (4.0 * D - 0.5 * slopes) / 3.0 : D;
}

/* What u_j - u_i along n exceeds the mean of both slopes by. */
static double bent(const struct sph *s, int i, int j, const double *d, const double *n)
{
    const int dim = s->dim;
    double sum = 0.0;
    for (int a = 0; a < dim; a++) {
        const double mean = 0.5 * (dot(slope_of(s, i) + dim + dim * a, d, dim) +
                                   dot(slope_of(s, j) + dim + dim * a, d, dim));
        sum += n[a] * (prim_of(s, j)[dim + a] - prim_of(s, i)[dim + a] - mean);
    }
    return sum;
}

/* Viscous force on i over w_i w_j mu [2.31, 2.32], area = |W'|. */
static void add_viscous(const struct sph *s, int i, int j, const double *n, double r, double area,
                        double *force)
{
    const int dim = s->dim;
    double D[3] = {0.0}, d[3] = {r * n[0], r * n[1], r * n[2]};
    for (int a = 0; a < dim; a++)
        D[a] = parting(s, i, j, d, a);
    for (int a = 0; a < dim; a++)
        force[a] += s->prm.viscosity == VISCOSITY_MORRIS
                        ? 2.0 * D[a] * area / r
                        : 2.0 * (dim + 2.0) * dot(D, n, dim) / r * area * n[a];
}

/* Adds what i gets from j: rates of momentum, volume, mass. */
static void add_pair(const struct sph *s, int i, int j, double *rate)
{
    const int dim = s->dim;
    double d[3] = {0.0}, n[3] = {0.0}, back[3] = {0.0}, u0[3] = {0.0}, viscous[3] = {0.0};
    const double r = between(s, i, j, d);
    if (r >= s->R)
        return;
    for (int a = 0; a < dim; a++) {
        n[a] = d[a] / r;
        back[a] = -d[a];
    }
    const struct side I = side_of(s, i, j, d), J = side_of(s, j, i, back);
    const double area = -kernel_dw_r(dim, r, s->R) * r;
    const double ww = prim_of(s, i)[2 * dim] * prim_of(s, j)[2 * dim], Z = I.Z + J.Z;
    const double ui = dot(I.u, n, dim), uj = dot(J.u, n, dim);
    const double bound = s->prm.low_dissipation ? fmin(1.0, 3.0 * fmax(ui - uj, 0.0) / s->c0) : 1.0;
    const double uE = (I.Z * ui + J.Z * uj + I.p - J.p) / Z; /* [2.100] */
    const double even = (1.0 - bound) * 2.0 / 3.0 * s->prm.dissipation * bent(s, i, j, d, n);
    const double pE = (J.Z * I.p + I.Z * J.p + I.Z * J.Z * (bound * (ui - uj) - even)) / Z;
    if (s->nu > 0.0)
        add_viscous(s, i, j, n, r, area, viscous);
    for (int a = 0; a < dim; a++) {
        u0[a] = 0.5 * (I.u0[a] + J.u0[a]);
        rate[a] += ww * (kernel_pair_viscosity(s) * viscous[a] - 2.0 * pE * area * n[a]);
    }
    if (s->prm.scheme == SCHEME_RIEMANN) {
        rate[dim] += ww * 2.0 * (uE - dot(prim_of(s, i) + dim, n, dim)) * area; /* [2.97] */
        return;
    }
    const double rhoE = 0.5 * (I.rho + J.rho) + (pE - 0.5 * (I.p + J.p)) / (s->c0 * s->c0);
    const double through = uE - dot(u0, n, dim);
    const struct side *up = through > 0.0 ? &I : &J;
    const double m = ww * 2.0 * rhoE * through * area; /* [2.88] */
    for (int a = 0; a < dim; a++)
        rate[a] -= m * (up->u[a] + (uE - dot(up->u, n, dim)) * n[a]); /* [2.89] */
    rate[dim] += ww * (dot(J.u0, n, dim) - dot(I.u0, n, dim)) * area; /* [2.87] */
    /* -rho/2 (shift_i u_j + shift_j u_i) instead of -rho/4 (shift_i + shift_j)(u_i + u_j) */
    double apart = 0.0;
    for (int a = 0; a < dim && s->prm.transport != TRANSPORT_EULERIAN; a++)
        apart += n[a] * (I.u0[a] - prim_of(s, i)[dim + a] - J.u0[a] + prim_of(s, j)[dim + a]);
    for (int a = 0; a < dim; a++)
        rate[a] += ww * 0.5 * rhoE * apart * area * parting(s, i, j, d, a);
    rate[dim + 1] -= m;
}

/* Rates of momentum, volume and mass of all particles: largest difference over the largest value of
 * each kind. */
static double worst_rate(const struct sph *s)
{
    const int dim = s->dim;
    double most[3] = {1e-300, 1e-300, 1e-300}, off[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < s->p.n; i++) {
        double wanted[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
        for (int j = 0; j < s->p.n; j++)
            if (j != i)
                add_pair(s, i, j, wanted);
        for (int k = 0; k < dim + 2; k++) {
            const int kind = k < dim ? 0 : k - dim + 1;
            most[kind] = fmax(most[kind], fabs(wanted[k]));
            off[kind] = fmax(off[kind], fabs(rate_of(s, i)[dim + k] - wanted[k]));
            if (!isfinite(rate_of(s, i)[dim + k]))
                return INFINITY;
        }
    }
    return fmax(fmax(off[0] / most[0], off[1] / most[1]), off[2] / most[2]);
}

static void choose(struct sph *s, int scheme, int limiter, int viscosity, double gamma, bool low)
{
    s->prm.scheme = scheme;
    s->prm.limiter = limiter;
    s->prm.viscosity = viscosity == OFF ? VISCOSITY_MORRIS : viscosity;
    s->nu = viscosity == OFF ? 0.0 : 0.05;
    s->gamma = s->prm.gamma = gamma;
    s->prm.low_dissipation = low;
    s->prm.dissipation = low ? 0.1 : 0.0;
    s->prm.dissipation_order = DISSIPATION_THIRD;
    s->passes = scheme_pick(s);
    particles_lines(s);
}

/* Slopes of all signs and sizes, so that every branch of the limiters is met. */
static void shake_slopes(struct toy *t)
{
    for (int k = 0; k < t->s.p.n * t->s.p.nslope; k++)
        t->s.p.slope[k] *= 1.0 + 2.0 * toy_random(t);
}

TEST(rates_are_the_double_loop)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct toy t;
        toy_small(&t, dim);
        toy_prepare(&t);
        t.s.passes.gradients(&t.s);
        shake_slopes(&t);
        for (int v = 0; v < 2 * 3 * 3 * 2 * 2; v += SANITIZED ? 5 : 1) {
            choose(&t.s, v % 2, v / 2 % 3, v / 6 % 3, v / 18 % 2 ? 1.0 : 7.0, v / 36);
            t.s.passes.rates(&t.s);
            assert_close(worst_rate(&t.s), 0.0, 1e-12);
        }
        toy_free(&t);
    }
}

TEST(positions_move_with_u0)
{
    for (int transport = TRANSPORT_TVS; transport <= TRANSPORT_EULERIAN; transport++) {
        struct toy t;
        toy_small(&t, 3);
        t.s.prm.transport = transport;
        toy_prepare(&t);
        t.s.passes.gradients(&t.s);
        t.s.passes.rates(&t.s);
        for (int i = 0; i < t.s.p.n; i++)
            for (int a = 0; a < 3; a++) {
                assert_true(rate_of(&t.s, i)[a] == slope_of(&t.s, i)[12 + a]);
                if (transport == TRANSPORT_NONE)
                    assert_true(rate_of(&t.s, i)[a] == prim_of(&t.s, i)[3 + a]);
                if (transport == TRANSPORT_EULERIAN)
                    assert_true(rate_of(&t.s, i)[a] == 0.0 && rate_of(&t.s, i)[6] == 0.0);
            }
        toy_free(&t);
    }
}

/* u = A x, rho = rho0 + b.x, on whatever places the particles have. */
static void set_linear(struct sph *s, double A[3][3], const double *b)
{
    for (int i = 0; i < s->p.n; i++) {
        const double *y = s->p.y + s->p.nstate * i;
        double x[3] = {y[0], y[1], s->dim == 3 ? y[2] : 0.0}, u[3];
        for (int a = 0; a < s->dim; a++)
            u[a] = dot(A[a], x, s->dim);
        particles_set(s, i, x, u, y[2 * s->dim], s->rho0 + dot(b, x, s->dim));
    }
}

TEST(gradients_are_exact_on_linear_fields)
{
    double A[3][3] = {{1.0, -2.0, 0.5}, {3.0, -1.0, 0.25}, {-0.75, 4.0, 2.0}},
           b[3] = {7.0, -3.0, 5.0};
    for (int dim = 2; dim <= 3; dim++) {
        struct toy t;
        int exact = 0;
        toy_create(&t, dim, dim == 2 ? 16 : 8, 2.8, 0.3);
        set_linear(&t.s, A, b);
        toy_prepare(&t);
        t.s.passes.gradients(&t.s);
        for (int i = 0; i < t.s.p.n; i++) {
            const double *g = slope_of(&t.s, i);
            const double share = g[0] / b[0]; /* less than all where neighbours are few */
            assert_true(share >= 0.0 && share < 1.0 + 1e-9);
            exact += share > 1.0 - 1e-9;
            for (int c = 0; c < dim; c++) {
                assert_close(g[c], share * b[c], 1e-10 * t.s.rho0);
                for (int a = 0; a < dim; a++)
                    assert_close(g[dim + dim * a + c], share * A[a][c], 1e-10);
            }
        }
        assert_true(exact > t.s.p.n * 9 / 10);
        toy_free(&t);
    }
}

/* A particle alone, and three in a line: no gradient can be had; u0 stays u and nothing is
 * infinite. */
TEST(few_neighbours_give_no_slope)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct toy t;
        toy_create(&t, dim, 4, 2.5, 0.0);
        for (int k = 0; k < 4; k++) {
            const double x[3] = {k == 3 ? 2.0 : 0.1 * k, 0.0, 0.0}, u[3] = {0.1 * k, 0.2, 0.3};
            particles_set(&t.s, k, x, u, t.s.dxD, t.s.rho0 * (1.0 + 0.001 * k));
        }
        t.s.p.n = 4;
        toy_prepare(&t);
        t.s.passes.gradients(&t.s);
        t.s.passes.rates(&t.s);
        for (int i = 0; i < 4; i++) {
            const double *g = slope_of(&t.s, i);
            for (int k = 0; k < dim + dim * dim; k++)
                assert_true(g[k] == 0.0);
            for (int k = 0; k < t.s.p.nstate; k++)
                assert_true(isfinite(rate_of(&t.s, i)[k]));
            if (prim_of(&t.s, i)[0] > 1.0) {
                assert_true(g[dim + dim * dim] == prim_of(&t.s, i)[dim]);
                assert_true(rate_of(&t.s, i)[dim] == 0.0 && rate_of(&t.s, i)[2 * dim + 1] == 0.0);
            }
        }
        toy_free(&t);
    }
}

/* Sums of the rates of mass and momentum over their absolute values. */
static double imbalance(const struct sph *s)
{
    const int dim = s->dim;
    double worst = 0.0;
    for (int k = dim; k < 2 * dim + 2; k++) {
        double sum = 0.0, size = 1e-300;
        for (int i = 0; i < s->p.n; i++) {
            sum += rate_of(s, i)[k];
            size += fabs(rate_of(s, i)[k]);
        }
        if (k != 2 * dim)
            worst = fmax(worst, fabs(sum) / size);
    }
    return worst;
}

TEST(mass_and_momentum_are_kept)
{
    for (int dim = 2; dim <= 3; dim++)
        for (int v = 0; v < 2 * 3 * 3; v++) {
            struct toy t;
            toy_create(&t, dim, dim == 2 ? 25 : 9, 2.7, 0.3);
            toy_prepare(&t);
            choose(&t.s, v % 2, v / 2 % 3, v / 6, 7.0, true);
            t.s.passes.gradients(&t.s);
            t.s.passes.rates(&t.s);
            assert_close(imbalance(&t.s), 0.0, 1e-13);
            toy_free(&t);
        }
}

TEST(gravity_acts_on_the_mass)
{
    struct toy t;
    toy_small(&t, 2);
    toy_prepare(&t);
    t.s.passes.gradients(&t.s);
    t.s.passes.rates(&t.s);
    double *before = NEW(double, t.s.p.n *t.s.p.nstate);
    memcpy(before, t.s.p.rate, (size_t)(t.s.p.n * t.s.p.nstate) * sizeof *before);
    t.s.gravity[1] = -9.81;
    t.s.passes.rates(&t.s);
    for (int i = 0; i < t.s.p.n; i++) {
        const double m = t.s.p.y[6 * i + 5], fall = rate_of(&t.s, i)[3] - before[6 * i + 3];
        assert_close(fall, -9.81 * m, 1e-9 * m);
        assert_true(rate_of(&t.s, i)[2] == before[6 * i + 2]);
    }
    mem_free(before);
    toy_free(&t);
}

/* Index of the particle nearest to the middle of the box. */
static int middle_of(const struct sph *s)
{
    const double centre[3] = {0.5, 0.5, 0.5};
    int best = 0;
    double least = INFINITY;
    for (int i = 0; i < s->p.n; i++) {
        double d[3] = {0.0}, r;
        for (int a = 0; a < s->dim; a++)
            d[a] = prim_of(s, i)[a] - centre[a];
        r = dot(d, d, s->dim);
        if (r < least) {
            least = r;
            best = i;
        }
    }
    return best;
}

/* u0 - u of the middle particle of a lattice, moved by `off' dx along x. */
static void middle_shift(int dim, int transport, double off, double *delta)
{
    struct toy t;
    toy_create(&t, dim, 11, 3.0, 0.0);
    t.s.prm.transport = transport;
    toy_prepare(&t);
    const int i = middle_of(&t.s);
    t.s.p.y[t.s.p.nstate * i] += off * t.s.dx;
    particles_lines(&t.s);
    t.s.passes.gradients(&t.s);
    for (int a = 0; a < dim; a++)
        delta[a] = slope_of(&t.s, i)[dim + dim * dim + a] - prim_of(&t.s, i)[dim + a];
    toy_free(&t);
}

TEST(transport_restores_and_rests)
{
    double delta[3];
    for (int dim = 2; dim <= 3; dim++)
        for (int transport = TRANSPORT_TVS; transport <= TRANSPORT_TVO; transport++) {
            middle_shift(dim, transport, 0.0, delta);
            assert_close(sqrt(dot(delta, delta, dim)), 0.0, 1e-13);
            middle_shift(dim, transport, 0.1, delta);
            assert_true(delta[0] < -1e-3);
            middle_shift(dim, transport, -0.1, delta);
            assert_true(delta[0] > 1e-3);
            assert_close(delta[1], 0.0, 1e-13);
        }
}

/* The laws in full [2.112-2.114] against a plain sum, limits included. */
TEST(transport_is_the_plain_sum)
{
    for (int v = 0; v < 4; v++) {
        struct toy t;
        toy_small(&t, 2 + v % 2);
        t.s.prm.transport = v / 2 ? TRANSPORT_TVO : TRANSPORT_TVS;
        toy_prepare(&t);
        t.s.passes.gradients(&t.s);
        const struct sph *s = &t.s;
        const double R = v / 2 ? 2.0 * s->dx : s->R;
        const int dim = s->dim;
        for (int i = 0; i < s->p.n; i++) {
            const double *u = prim_of(s, i) + dim;
            double delta[3] = {0.0}, d[3] = {0.0};
            for (int j = 0; j < s->p.n; j++) {
                const double r = between(s, i, j, d);
                const double f = kernel_w(dim, r, s->R) / kernel_w(dim, s->dx, s->R);
                const double more = v / 2 ? 0.5 : 1.0 + 0.2 * f * f * f * f;
                for (int a = 0; a < dim && j != i; a++)
                    delta[a] += 2.0 * R * s->dxD * more * kernel_dw_r(dim, r, R) * d[a];
            }
            const double most = 0.25 * (v / 2 ? sqrt(dot(u, u, dim)) : 1.0);
            const double size = sqrt(dot(delta, delta, dim)), cut = fmin(1.0, most / size);
            for (int a = 0; a < dim; a++)
                assert_close(slope_of(s, i)[dim + dim * dim + a], u[a] + cut * delta[a], 1e-9);
        }
        toy_free(&t);
    }
}

/* As a stage does it on several ranks. */
static void in_two_parts(struct sph *s, void (*pass)(struct sph *s))
{
    neighbours_rows(s->list, ROWS_INNER);
    pass(s);
    neighbours_rows(s->list, ROWS_OUTER);
    pass(s);
    neighbours_rows(s->list, ROWS_ALL);
}

/* Locals next to ghosts get what they get when all are locals, whatever the order of rows; so do
 * those of a rank that no ghost reaches, whose second part is empty. */
static void act_like_locals(int dim, int scheme, double cut)
{
    struct toy all, t;
    toy_create(&all, dim, dim == 2 ? 18 : 8, 2.6, 0.25);
    all.s.prm.scheme = scheme;
    toy_prepare(&all);
    all.s.passes.gradients(&all.s);
    all.s.passes.rates(&all.s);
    toy_create(&t, dim, dim == 2 ? 18 : 8, 2.6, 0.25);
    t.s.prm.scheme = scheme;
    t.run.size = 2;
    toy_split(&t, &all, cut);
    assert_true(t.s.list->ninner > 0 && (t.s.list->ninner < t.s.p.n) == (cut < 1.0));
    in_two_parts(&t.s, t.s.passes.gradients);
    in_two_parts(&t.s, t.s.passes.rates);
    for (int i = 0; i < t.s.p.n; i++) {
        int k = 0;
        while (all.s.p.id[k] != t.s.p.id[i])
            k++;
        for (int a = 0; a < t.s.p.nstate; a++)
            assert_close(rate_of(&t.s, i)[a], rate_of(&all.s, k)[a],
                         1e-9 * (1.0 + fabs(rate_of(&all.s, k)[a])));
    }
    toy_free(&t);
    toy_free(&all);
}

TEST(ghosts_act_like_locals)
{
    for (int dim = 2; dim <= 3; dim++)
        for (int scheme = SCHEME_RIEMANN_ALE; scheme <= SCHEME_STANDARD; scheme++) {
            act_like_locals(dim, scheme, 0.55);
            act_like_locals(dim, scheme, 2.0);
        }
}
