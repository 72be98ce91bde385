/* test_scheme_delta.c - the passes of delta-SPH and of the pair with artificial viscosity against
 * double loops written from the equations, and against the laws they must keep.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/kernel.h"
#include "../../../sph/pairs/kernel_sums.h"
#include "../../../sph/particles/eos.h"
#include "sph_toy.h"

enum { OFF = 2 };

static double pressure_of(const struct sph *s, int i)
{
    return eos_p(prim_of(s, i)[2 * s->dim + 1], s->rho0, s->c0, s->gamma);
}

/* A pair as the equations see it from i. */
struct pair {
    double d[3], D[3], r, gradW[3], X; /* x_j - x_i, u_j - u_i, |d|, grad_i W, D.d */
    double rho[2], c[2];
};

static struct pair pair_of(const struct sph *s, int i, int j)
{
    const int dim = s->dim;
    const double *a = prim_of(s, i), *b = prim_of(s, j);
    struct pair p = {0};
    for (int k = 0; k < dim; k++) {
        p.d[k] = b[k] - a[k];
        p.D[k] = b[dim + k] - a[dim + k];
    }
    p.r = sqrt(dot(p.d, p.d, dim));
    p.X = dot(p.D, p.d, dim);
    for (int k = 0; k < dim; k++)
        p.gradW[k] = -kernel_dw_r(dim, p.r, s->R) * p.d[k];
    p.rho[0] = a[2 * dim + 1];
    p.rho[1] = b[2 * dim + 1];
    for (int k = 0; k < 2; k++)
        p.c[k] = eos_c(p.rho[k], s->rho0, s->c0, s->gamma);
    return p;
}

/* [2.58-2.59] */
static double artificial(const struct sph *s, const struct pair *p)
{
    const double mu = p->X < 0.0 ? p->X / (p->r * p->r + 1e-4 * s->R * s->R) : 0.0;
    return -s->prm.alpha / 16.0 * (p->rho[0] + p->rho[1]) * 2.0 * s->R * (p->c[0] + p->c[1]) * mu;
}

/* Adds what i gets from j over its volume: force of [2.49] and of [2.62], [2.31] or [2.32], and
 * -rho div u, diffusion of rho [2.60]. */
static void add_pair(const struct sph *s, int i, int j, double *force, double *drho)
{
    const int dim = s->dim;
    const struct pair p = pair_of(s, i, j);
    if (p.r >= s->R)
        return;
    const double w = prim_of(s, j)[2 * dim], r2 = p.r * p.r, mu = kernel_pair_viscosity(s);
    double P = pressure_of(s, i) + pressure_of(s, j);
    if (s->prm.scheme == SCHEME_STANDARD)
        P += artificial(s, &p);
    else
        P -= s->prm.alpha * s->c0 * s->R * s->rho0 * p.X / r2;
    *drho -= p.rho[0] * w * dot(p.D, p.gradW, dim);
    for (int a = 0; a < dim; a++) {
        force[a] -= w * P * p.gradW[a];
        if (s->nu > 0.0)
            force[a] += s->prm.viscosity == VISCOSITY_MORRIS
                            ? mu * w * 2.0 * p.D[a] * dot(p.d, p.gradW, dim) / r2
                            : mu * w * 2.0 * (dim + 2.0) * p.X / r2 * p.gradW[a];
        if (s->prm.scheme == SCHEME_DELTA && s->prm.delta > 0.0) {
            const double psi =
                2.0 * (p.rho[1] - p.rho[0]) * p.d[a] / r2 - (slope_of(s, i)[a] + slope_of(s, j)[a]);
            *drho += s->prm.delta * s->c0 * s->R * w * psi * p.gradW[a];
        }
    }
}

/* Rates of particle i by the double loop: q, w. */
static void plain_rates(const struct sph *s, int i, double *rate)
{
    const int dim = s->dim;
    const double *prim = prim_of(s, i), *u = prim + dim, *g = slope_of(s, i);
    const double *gu = g + dim, *u0 = gu + dim * dim, w = prim[2 * dim], rho = prim[2 * dim + 1];
    double force[3] = {0.0}, drho = 0.0;
    for (int j = 0; j < s->p.n; j++)
        if (j != i)
            add_pair(s, i, j, force, &drho);
    for (int b = 0; b < dim && s->prm.transport <= TRANSPORT_TVO; b++) {
        drho += (u0[b] - u[b]) * g[b];
        for (int a = 0; a < dim; a++)
            force[a] += rho * (u0[b] - u[b]) * gu[dim * a + b];
    }
    for (int a = 0; a < dim; a++)
        rate[a] = w * force[a];
    rate[dim] = -w / rho * drho;
}

/* Largest difference over the largest value, of momentum and of volume. */
static double worst_rate(const struct sph *s)
{
    const int dim = s->dim;
    double most[2] = {1e-300, 1e-300}, off[2] = {0.0, 0.0};
    for (int i = 0; i < s->p.n; i++) {
        double wanted[4];
        plain_rates(s, i, wanted);
        for (int k = 0; k <= dim; k++) {
            most[k == dim] = fmax(most[k == dim], fabs(wanted[k]));
            off[k == dim] = fmax(off[k == dim], fabs(rate_of(s, i)[dim + k] - wanted[k]));
            assert_true(isfinite(rate_of(s, i)[dim + k]));
        }
        assert_true(rate_of(s, i)[2 * dim + 1] == 0.0);
    }
    return fmax(off[0] / most[0], off[1] / most[1]);
}

static void set(struct toy *t, int scheme, int transport, int viscosity, double gamma)
{
    struct sph *s = &t->s;
    s->prm.scheme = scheme;
    s->prm.transport = transport;
    s->prm.viscosity = viscosity == OFF ? VISCOSITY_MORRIS : viscosity;
    s->nu = viscosity == OFF ? 0.0 : 0.05;
    s->gamma = s->prm.gamma = gamma;
    s->prm.alpha = 0.3;
    s->prm.delta = 0.05;
}

static void evaluate(struct toy *t)
{
    toy_prepare(t);
    if (t->s.scheme->gradients)
        t->s.scheme->gradients(&t->s);
    t->s.scheme->rates(&t->s);
}

TEST(rates_are_the_double_loop)
{
    static const int transports[3] = {TRANSPORT_TVS, TRANSPORT_NONE, TRANSPORT_XSPH};
    for (int dim = 2; dim <= 3; dim++)
        for (int v = 0; v < 2 * 3 * 3 * 2 * 2; v += SANITIZED ? 5 : 1) {
            struct toy t;
            toy_small(&t, dim);
            set(&t, v % 2 ? SCHEME_DELTA : SCHEME_STANDARD, transports[v / 2 % 3], v / 6 % 3,
                v / 18 % 2 ? 1.0 : 7.0);
            t.s.prm.delta *= v / 36;
            evaluate(&t);
            assert_close(worst_rate(&t.s), 0.0, 1e-12);
            toy_free(&t);
        }
}

/* What the scheme does without must not change what it gives. */
TEST(lean_gradients_are_those_of_the_full_pass)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct toy t;
        toy_small(&t, dim);
        set(&t, SCHEME_DELTA, TRANSPORT_NONE, OFF, 7.0);
        evaluate(&t);
        struct sph *s = &t.s;
        double *lean = NEW(double, s->p.n * s->p.nslope);
        memcpy(lean, s->p.slope, (size_t)(s->p.n * s->p.nslope) * sizeof *lean);
        scheme_gradients(dim, TRANSPORT_NONE)(s);
        for (int i = 0; i < s->p.n; i++)
            for (int a = 0; a < dim; a++) {
                const double *g = slope_of(s, i), *l = lean + s->p.nslope * i;
                assert_close(l[a], g[a], 1e-10 * s->rho0);
                assert_true(l[dim + dim * dim + a] == g[dim + dim * dim + a]);
            }
        mem_free(lean);
        toy_free(&t);
    }
}

/* Without transport particles move with u, with or without a first pass. */
TEST(positions_move_with_u)
{
    for (int v = 0; v < 2; v++) {
        struct toy t;
        toy_small(&t, 3);
        set(&t, v ? SCHEME_DELTA : SCHEME_STANDARD, TRANSPORT_NONE, OFF, 7.0);
        evaluate(&t);
        assert_true((t.s.scheme->gradients != NULL) == (v == 1));
        for (int i = 0; i < t.s.p.n; i++)
            for (int a = 0; a < 3; a++) {
                assert_true(rate_of(&t.s, i)[a] == prim_of(&t.s, i)[3 + a]);
                assert_true(slope_of(&t.s, i)[12 + a] == prim_of(&t.s, i)[3 + a]);
            }
        toy_free(&t);
    }
}

/* [2.106] with eps = 0.5, for the schemes of both kinds. */
TEST(xsph_is_the_plain_sum)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct toy t;
        toy_small(&t, dim);
        set(&t, dim == 2 ? SCHEME_STANDARD : SCHEME_RIEMANN_ALE, TRANSPORT_XSPH, OFF, 7.0);
        evaluate(&t);
        const struct sph *s = &t.s;
        for (int i = 0; i < s->p.n; i++) {
            double u0[3] = {0.0};
            for (int j = 0; j < s->p.n; j++) {
                const struct pair p = pair_of(s, i, j);
                const double W = kernel_w(dim, p.r, s->R), m = prim_of(s, j)[2 * dim] * p.rho[1];
                for (int a = 0; a < dim; a++)
                    u0[a] += 2.0 * 0.5 * m * p.D[a] / (p.rho[0] + p.rho[1]) * W;
            }
            for (int a = 0; a < dim; a++)
                assert_close(rate_of(s, i)[a], prim_of(s, i)[dim + a] + u0[a], 1e-12);
        }
        toy_free(&t);
    }
}

TEST(momentum_is_kept)
{
    for (int v = 0; v < 2 * 2 * 3; v++) {
        struct toy t;
        const int dim = 2 + v % 2;
        toy_create(&t, dim, dim == 2 ? 25 : 9, 2.7, 0.3);
        set(&t, v / 2 % 2 ? SCHEME_DELTA : SCHEME_STANDARD, TRANSPORT_NONE, v / 4, 7.0);
        evaluate(&t);
        for (int a = 0; a < dim; a++) {
            double sum = 0.0, size = 1e-300;
            for (int i = 0; i < t.s.p.n; i++) {
                sum += rate_of(&t.s, i)[dim + a];
                size += fabs(rate_of(&t.s, i)[dim + a]);
            }
            assert_close(sum / size, 0.0, 1e-13);
        }
        toy_free(&t);
    }
}

/* <G+(P), u> = -<P, D-(u)> [2.51-2.57]: without dissipation the power of the forces is what volumes
 * take up. */
TEST(gradient_and_divergence_are_adjoint)
{
    for (int v = 0; v < 4; v++) {
        struct toy t;
        const int dim = 2 + v % 2;
        toy_small(&t, dim);
        set(&t, v / 2 ? SCHEME_DELTA : SCHEME_STANDARD, TRANSPORT_NONE, OFF, 7.0);
        t.s.prm.alpha = t.s.prm.delta = 0.0;
        evaluate(&t);
        double power = 0.0, taken = 0.0, size = 0.0;
        for (int i = 0; i < t.s.p.n; i++) {
            const double *u = prim_of(&t.s, i) + dim, *rate = rate_of(&t.s, i);
            power += dot(rate + dim, u, dim);
            taken += pressure_of(&t.s, i) * rate[2 * dim];
            size += fabs(dot(rate + dim, u, dim));
        }
        assert_close((power - taken) / size, 0.0, 1e-10);
        toy_free(&t);
    }
}

/* Sum of a_i b_i: power of the forces, and of rho against its own diffusion. */
static void sums_of(const struct toy *t, double *power, double *variance)
{
    const struct sph *s = &t->s;
    const int dim = s->dim;
    *power = *variance = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *prim = prim_of(s, i), rho = prim[2 * dim + 1];
        *power += dot(rate_of(s, i) + dim, prim + dim, dim);
        *variance -= rho * rho * rate_of(s, i)[2 * dim]; /* w rho drho/dt */
    }
}

/* Change of both sums by one key from 0 to its value. */
static void effect(int dim, int scheme, double alpha, double delta, double *power, double *variance)
{
    double before[2] = {0.0, 0.0};
    for (int on = 0; on <= 1; on++) {
        struct toy t;
        toy_small(&t, dim);
        set(&t, scheme, TRANSPORT_NONE, OFF, 7.0);
        t.s.prm.alpha = on * alpha;
        t.s.prm.delta = on * delta;
        evaluate(&t);
        sums_of(&t, power, variance);
        if (!on) {
            before[0] = *power;
            before[1] = *variance;
        }
        toy_free(&t);
    }
    *power -= before[0];
    *variance -= before[1];
}

TEST(both_terms_dissipate)
{
    double power, variance;
    for (int dim = 2; dim <= 3; dim++) {
        effect(dim, SCHEME_DELTA, 0.02, 0.0, &power, &variance);
        assert_true(power < -1e-6 && variance == 0.0);
        effect(dim, SCHEME_STANDARD, 0.02, 0.0, &power, &variance);
        assert_true(power < -1e-6 && variance == 0.0);
        effect(dim, SCHEME_DELTA, 0.0, 0.05, &power, &variance);
        assert_true(power == 0.0 && variance < -1e-6);
    }
}

/* The volume that diffusion takes from one side of a pair it gives to the other as mass of fluid:
 * sum w drho/dt = 0. */
TEST(diffusion_moves_density_only)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct toy t;
        toy_small(&t, dim);
        for (int i = 0; i < t.s.p.n; i++) /* at rest: diffusion alone */
            memset(t.s.p.y + t.s.p.nstate * i + dim, 0, (size_t)dim * sizeof(double));
        set(&t, SCHEME_DELTA, TRANSPORT_NONE, OFF, 7.0);
        evaluate(&t);
        double sum = 0.0, size = 1e-300;
        for (int i = 0; i < t.s.p.n; i++) {
            const double flow = prim_of(&t.s, i)[2 * dim + 1] * rate_of(&t.s, i)[2 * dim];
            sum += flow;
            size += fabs(flow);
        }
        assert_close(sum / size, 0.0, 1e-12);
        toy_free(&t);
    }
}

/* [2.105] adds P_min to the pressure of both sides, which lifts the least one to 0. */
TEST(background_lifts_all_pressures)
{
    for (int scheme = SCHEME_RIEMANN_ALE; scheme <= SCHEME_STANDARD; scheme++) {
        struct toy t;
        toy_small(&t, 2);
        t.run.comm = MPI_COMM_WORLD;
        set(&t, scheme, TRANSPORT_NONE, OFF, 7.0);
        evaluate(&t);
        struct sph *s = &t.s;
        double least = 0.0, *plain = NEW(double, s->p.n * s->p.nstate);
        memcpy(plain, s->p.rate, (size_t)(s->p.n * s->p.nstate) * sizeof *plain);
        for (int i = 0; i < s->p.n; i++)
            least = fmin(least, pressure_of(s, i));
        s->prm.background = true;
        s->background = scheme_background(s);
        s->scheme->rates(s);
        for (int i = 0; i < s->p.n; i++) {
            double lift[3] = {0.0};
            for (int j = 0; j < s->p.n; j++) {
                const struct pair p = pair_of(s, i, j);
                for (int a = 0; a < 2; a++)
                    lift[a] += 2.0 * least * prim_of(s, j)[4] * p.gradW[a];
            }
            for (int a = 0; a < 2; a++)
                assert_close(rate_of(s, i)[2 + a] - plain[6 * i + 2 + a],
                             prim_of(s, i)[4] * lift[a], 1e-9);
            for (int k = 4; k < 6; k++)
                assert_close(rate_of(s, i)[k], plain[6 * i + k], 1e-9);
        }
        mem_free(plain);
        toy_free(&t);
    }
}
