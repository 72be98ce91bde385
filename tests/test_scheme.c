/* test_scheme.c - both pair passes against a plain double loop written from the equations, against
 * what they must keep, and on fields for which they are exact.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "test.h"

#include "../sph/eos.h"
#include "../sph/kernel.h"
#include "../sph/neighbours.h"
#include "../sph/scheme.h"
#include "sph_case.h"

enum { PRIM = 8 };

/* A disordered periodic set with random velocities and densities; list and ghosts ready. */
static struct sph *start(struct sph_case *c, int dim, int scheme, int limiter)
{
    sph_case_set(c, dim, dim == 2 ? 16 : 8);
    c->prm.noise = 0.2;
    c->prm.scheme = scheme;
    c->prm.limiter = limiter;
    struct sph *s = sph_case_start(c, NULL);
    srand(1);
    for (int i = 0; i < s->p.n; i++) {
        double *y = s->p.y + (size_t)i * s->p.nstate;
        y[2 * dim] = s->dxD * (1.0 + 0.05 * rand() / RAND_MAX);
        y[2 * dim + 1] = y[2 * dim] * (1.0 + 0.01 * rand() / RAND_MAX);
        for (int a = 0; a < dim; a++)
            y[dim + a] = y[2 * dim + 1] * (2.0 * rand() / RAND_MAX - 1.0);
    }
    s->ready = false;
    integrate_prepare(s);
    return s;
}

/* x_j - x_i by the nearest image, the only one within R here. */
static double apart(const struct sph *s, int i, int j, double *d)
{
    double r2 = 0.0;
    for (int a = 0; a < s->dim; a++) {
        d[a] = s->p.y[(size_t)j * s->p.nstate + a] - s->p.y[(size_t)i * s->p.nstate + a];
        d[a] -= rint(d[a]);
        r2 += d[a] * d[a];
    }
    return sqrt(r2);
}

static double clip(double v, double lo, double hi) { return v < lo ? lo : v > hi ? hi : v; }

/* phi(middle) - phi_i of the reconstruction, as the methods print it. */
static double half(double D, double s, int limiter)
{
    if (limiter == LIMITER_NONE)
        return 0.5 * s;
    if (D == 0.0)
        return 0.0;
    const double theta = s / D, r = 2.0 * theta - 1.0;
    if (limiter == LIMITER_MINMOD)
        return 0.5 * clip(theta, 0.0, 1.0) * D;
    return 0.5 * fmax(0.0, fmin(2.0 * r, fmin((2.0 + r) / 3.0, 2.0))) * D;
}

/* State of particle i on the way to j: rho, u, then P and c. */
static void state_towards(const struct sph *s, int i, int j, const double *d, double *rho,
                          double *u, double *P, double *c)
{
    const int dim = s->dim;
    const double *p = s->p.prim + (size_t)PRIM * i, *q = s->p.prim + (size_t)PRIM * j;
    const double *g = s->p.slope + (size_t)s->p.nslope * i;
    double along[4] = {0}, div = 0.0;
    for (int f = 0; f <= dim; f++)
        for (int b = 0; b < dim; b++)
            along[f] += g[dim * f + b] * d[b];
    for (int a = 0; a < dim; a++) {
        u[a] = p[dim + a] + half(q[dim + a] - p[dim + a], along[a + 1], s->prm.limiter);
        div += g[dim * (a + 1) + a];
    }
    *rho = p[2 * dim + 1] + half(q[2 * dim + 1] - p[2 * dim + 1], along[0], s->prm.limiter);
    *P = eos_p(*rho, s->rho0, s->c0, s->gamma) - s->prm.damper * s->rho0 * s->c0 * s->R * div;
    *c = eos_c(*rho, s->rho0, s->c0, s->gamma);
}

/* Adds what j does to i, from [2.86-2.89] or [2.96-2.99], Morris [2.31], to rate (q, w, m). */
static void add_pair(const struct sph *s, int i, int j, double *rate)
{
    const int dim = s->dim;
    double d[3], back[3], n[3], ul[3], ur[3], rl, rr, Pl, Pr, cl, cr, vl = 0.0, vr = 0.0, v0 = 0.0,
                                                                      dv0 = 0.0, vi = 0.0;
    const double r = apart(s, i, j, d), slope = -kernel_dw_r(dim, r, s->R) * r; /* |W'| */
    const double *p = s->p.prim + (size_t)PRIM * i, *q = s->p.prim + (size_t)PRIM * j;
    const double *u0i = s->p.slope + (size_t)s->p.nslope * i + dim + dim * dim;
    const double *u0j = s->p.slope + (size_t)s->p.nslope * j + dim + dim * dim;
    for (int a = 0; a < dim; a++)
        back[a] = -d[a];
    state_towards(s, i, j, d, &rl, ul, &Pl, &cl);
    state_towards(s, j, i, back, &rr, ur, &Pr, &cr);
    for (int a = 0; a < dim; a++) {
        n[a] = d[a] / r;
        vl += ul[a] * n[a];
        vr += ur[a] * n[a];
        v0 += 0.5 * (u0i[a] + u0j[a]) * n[a];
        dv0 += (u0j[a] - u0i[a]) * n[a];
        vi += p[dim + a] * n[a];
    }
    /* impedances of the particles, not of their states: the difference is of the order of the jump
     */
    const double Zl = p[2 * dim + 1] * eos_c(p[2 * dim + 1], s->rho0, s->c0, s->gamma);
    const double Zr = q[2 * dim + 1] * eos_c(q[2 * dim + 1], s->rho0, s->c0, s->gamma);
    const double beta = s->prm.low_dissipation ? fmin(1.0, 3.0 * fmax(vl - vr, 0.0) / s->c0) : 1.0;
    const double uE = (Zl * vl + Zr * vr + Pl - Pr) / (Zl + Zr);
    const double PE = (Zr * Pl + Zl * Pr + beta * Zl * Zr * (vl - vr)) / (Zl + Zr);
    const double w = p[2 * dim] * q[2 * dim] * slope;
    const bool ale = s->prm.scheme == SCHEME_RIEMANN_ALE;
    const double rhoE = 0.5 * (rl + rr) + (PE - 0.5 * (Pl + Pr)) / (s->c0 * s->c0);
    const double flux = ale ? 2.0 * w * rhoE * (uE - v0) : 0.0;
    for (int a = 0; a < dim; a++) {
        const double up = uE > v0 ? ul[a] + (uE - vl) * n[a] : ur[a] + (uE - vr) * n[a];
        rate[a] += -flux * up - 2.0 * w * PE * n[a] +
                   2.0 * w * s->rho0 * s->nu * (q[dim + a] - p[dim + a]) / r;
    }
    rate[dim] += ale ? w * dv0 : 2.0 * w * (uE - vi);
    rate[dim + 1] -= flux;
}

static void compare_rates(int dim, int scheme, int limiter)
{
    struct sph_case c;
    struct sph *s = start(&c, dim, scheme, limiter);
    integrate_rates(s);
    for (int i = 0; i < s->p.n; i += 7) {
        double want[5] = {0}, d[3], size = 0.0;
        for (int j = 0; j < s->p.n; j++)
            if (j != i && apart(s, i, j, d) < s->R)
                add_pair(s, i, j, want);
        const double *got = s->p.rate + (size_t)i * s->p.nstate;
        for (int k = 0; k < dim + 2; k++)
            size = fmax(size, fabs(want[k]));
        for (int k = 0; k < dim + 2; k++)
            assert_close(got[dim + k], want[k], 1e-9 * size);
        for (int a = 0; a < dim; a++)
            assert_close(got[a], s->p.slope[(size_t)s->p.nslope * i + dim + dim * dim + a], 0.0);
    }
    sph_free(&c.s);
}

static void rates_are_those_of_the_equations(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int limiter = LIMITER_KOREN; limiter <= LIMITER_NONE; limiter++) {
            compare_rates(dim, SCHEME_RIEMANN_ALE, limiter);
            compare_rates(dim, SCHEME_RIEMANN, limiter);
        }
}

static void pairs_keep_mass_and_momentum(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int scheme = SCHEME_RIEMANN_ALE; scheme <= SCHEME_RIEMANN; scheme++) {
            struct sph_case c;
            struct sph *s = start(&c, dim, scheme, LIMITER_KOREN);
            double sum[5] = {0}, size[5] = {0};
            integrate_rates(s);
            for (int i = 0; i < s->p.n; i++)
                for (int k = 0; k < dim + 2; k++) {
                    sum[k] += s->p.rate[(size_t)i * s->p.nstate + dim + k];
                    size[k] += fabs(s->p.rate[(size_t)i * s->p.nstate + dim + k]);
                }
            for (int k = 0; k < dim + 2; k++)
                if (k != dim) /* volumes follow div u0, their sum is not kept */
                    assert_close(sum[k], 0.0, 1e-13 * size[k] + 1e-300);
            sph_free(&c.s);
        }
}

/* Interior particles of a disordered set in a field that is linear where it counts. */
static void gradients_are_exact_on_linear_fields(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        struct sph_case c;
        struct sph *s = start(&c, dim, SCHEME_RIEMANN_ALE, LIMITER_KOREN);
        double x[3];
        for (int i = 0; i < s->p.n + s->p.nghost; i++) { /* ghosts as well: linear over the seam */
            double *p = s->p.prim + (size_t)PRIM * i;
            for (int a = 0; a < dim; a++)
                x[a] = p[a];
            for (int a = 0; a < dim; a++)
                p[dim + a] =
                    0.3 + (a + 1.0) * x[0] - 2.0 * x[1] + (dim == 3 ? 0.5 * a * x[2] : 0.0);
            p[2 * dim + 1] = 1.0 + 0.1 * x[0] + 0.2 * x[1];
        }
        s->scheme->gradients(s);
        for (int i = 0; i < s->p.n; i++) {
            const double *g = s->p.slope + (size_t)s->p.nslope * i;
            assert_close(g[0], 0.1, 1e-10);
            assert_close(g[1], 0.2, 1e-10);
            for (int a = 0; a < dim; a++) {
                assert_close(g[dim * (a + 1)], a + 1.0, 1e-10);
                assert_close(g[dim * (a + 1) + 1], -2.0, 1e-10);
                if (dim == 3)
                    assert_close(g[dim * (a + 1) + 2], 0.5 * a, 1e-10);
            }
        }
        sph_free(&c.s);
    }
}

/* On a lattice nothing is shifted; a particle moved off it is pushed back; the law's limit holds.
 */
static void transport_restores_the_lattice(void **state)
{
    (void)state;
    for (int law = TRANSPORT_TVS; law <= TRANSPORT_TVO; law++) {
        struct sph_case c;
        sph_case_set(&c, 2, 16);
        c.prm.transport = law;
        struct sph *s = sph_case_start(&c, NULL);
        integrate_gradients(s);
        for (int i = 0; i < s->p.n; i++)
            for (int a = 0; a < 2; a++)
                assert_close(s->p.slope[8 * (size_t)i + 6 + a], s->p.prim[8 * (size_t)i + 2 + a],
                             1e-12);
        int moved = 0; /* one in fast flow, for Oger's law is limited by |u| */
        for (int i = 0; i < s->p.n; i++)
            if (fabs(s->p.prim[8 * (size_t)i + 3]) > fabs(s->p.prim[8 * (size_t)moved + 3]))
                moved = i;
        s->p.y[(size_t)moved * s->p.nstate] += 0.1 * s->dx;
        const int64_t id = s->p.id[moved];
        s->ready = false;
        integrate_gradients(s);
        for (int i = 0; i < s->p.n; i++) {
            const double *u = s->p.prim + 8 * (size_t)i + 2, *u0 = s->p.slope + 8 * (size_t)i + 6;
            const double size = hypot(u0[0] - u[0], u0[1] - u[1]);
            assert_true(size <=
                        0.25 * (law == TRANSPORT_TVS ? 1.0 : hypot(u[0], u[1])) * (1.0 + 1e-12));
            if (s->p.id[i] == id)
                assert_true(u0[0] - u[0] < -1e-3);
        }
        sph_free(&c.s);
    }
}

static void list_holds_all_pairs_in_reach(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        struct sph_case c;
        struct sph *s = start(&c, dim, SCHEME_RIEMANN_ALE, LIMITER_KOREN);
        int64_t pairs = 0;
        double d[3];
        for (int i = 0; i < s->p.n; i++) {
            const int *j = s->list->j + s->list->start[i];
            int near = 0, tail = 0;
            for (int k = 0; k < s->p.n; k++) {
                const double r = k == i ? INFINITY : apart(s, i, k, d);
                near += r < s->R + s->skin;
                pairs += r < s->R;
            }
            assert_int_equal(s->list->count[i], near);
            for (int k = 0; k < s->list->count[i]; k++)
                tail += j[k] < i;
            assert_int_equal(s->list->tail[i], tail);
            for (int k = 0; k < tail; k++)
                assert_true(j[k] < i);
            assert_int_equal(j[s->list->count[i]], s->p.capacity); /* the dummy pads the row */
        }
        assert_int_equal(neighbours_pairs(s), pairs);
        sph_free(&c.s);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rates_are_those_of_the_equations),
                                       cmocka_unit_test(pairs_keep_mass_and_momentum),
                                       cmocka_unit_test(gradients_are_exact_on_linear_fields),
                                       cmocka_unit_test(transport_restores_the_lattice),
                                       cmocka_unit_test(list_holds_all_pairs_in_reach)};
    MPI_Init(&argc, &argv);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    MPI_Finalize();
    return failed;
}
