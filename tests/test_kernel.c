/* test_kernel.c - the kernel, the equation of state, the states and the Riemann problem of a pair.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "test.h"

#include "../sph/eos.h"
#include "../sph/kernel.h"
#include "../sph/riemann.h"

static void kernel_integrates_to_one(void **state)
{
    (void)state;
    const double R = 0.3;
    const int n = 20000;
    double plane = 0.0, space = 0.0;
    for (int i = 0; i < n; i++) { /* midpoints: W is smooth */
        const double r = (i + 0.5) * R / n, dr = R / n;
        plane += 2.0 * M_PI * r * kernel_w(2, r, R) * dr;
        space += 4.0 * M_PI * r * r * kernel_w(3, r, R) * dr;
    }
    assert_close(plane, 1.0, 1e-8);
    assert_close(space, 1.0, 1e-8);
    assert_close(kernel_w(2, R, R), 0.0, 0.0);
    assert_close(kernel_w(3, 2.0 * R, R), 0.0, 0.0);
}

static void slope_is_the_derivative(void **state)
{
    (void)state;
    const double R = 0.3, e = 1e-6;
    for (int dim = 2; dim <= 3; dim++)
        for (double r = 0.01; r < R; r += 0.02) {
            const double slope = (kernel_w(dim, r + e, R) - kernel_w(dim, r - e, R)) / (2.0 * e);
            assert_close(kernel_dw_r(dim, r, R) * r, slope, 1e-6 * kernel_w0(dim, R) / R);
        }
}

/* Table of neighbour sums on a lattice: sum w W = 1.005, 1.001 (2D, R/dx 3, 4), 1.013 (3D, 2.5). */
static void kernel_sums_on_a_lattice(void **state)
{
    (void)state;
    static const struct {
        int dim;
        double R, sum;
    } of[] = {{2, 3.0, 1.005}, {2, 4.0, 1.001}, {3, 2.5, 1.013}};
    for (size_t k = 0; k < 3; k++) {
        double sum = 0.0;
        for (int x = -4; x <= 4; x++)
            for (int y = -4; y <= 4; y++)
                for (int z = of[k].dim == 3 ? -4 : 0; z <= (of[k].dim == 3 ? 4 : 0); z++)
                    sum += kernel_w(of[k].dim, sqrt(x * x + y * y + z * z), of[k].R);
        assert_close(sum, of[k].sum, 6e-4);
    }
}

static void tait_and_its_inverse(void **state)
{
    (void)state;
    for (double gamma = 1.0; gamma <= 7.0; gamma += 6.0)
        for (double rho = 950.0; rho < 1060.0; rho += 10.0) {
            const double p = eos_p(rho, 1000.0, 30.0, gamma), e = 1e-3;
            assert_close(eos_rho(p, 1000.0, 30.0, gamma), rho, 1e-9 * rho);
            const double c2 =
                (eos_p(rho + e, 1000.0, 30.0, gamma) - eos_p(rho - e, 1000.0, 30.0, gamma)) /
                (2.0 * e);
            assert_close(eos_c(rho, 1000.0, 30.0, gamma), sqrt(c2), 1e-6 * sqrt(c2));
        }
    assert_true(isfinite(eos_rho(-1e9, 1000.0, 30.0, 7.0))); /* below any pressure of this fluid */
}

/* What reconstruct adds to the left value, and takes from the right one, for a difference D and
 * slopes s on both sides. */
static void steps(double D, double s, int limiter, double *left, double *right)
{
    vec l = vec_all(0.0), r = vec_all(D);
    reconstruct(&l, &r, vec_all(s), vec_all(s), limiter);
    *left = l[0];
    *right = D - r[0];
}

static void all_limiters_meet_on_linear_fields(void **state)
{
    (void)state;
    for (int limiter = LIMITER_KOREN; limiter <= LIMITER_NONE; limiter++)
        for (double D = -2.0; D <= 2.0;
             D += 0.5) { /* s = D: the gradient says what the pair says */
            double left, right;
            steps(D, D, limiter, &left, &right);
            assert_close(left, 0.5 * D, 1e-15);
            assert_close(right, 0.5 * D, 1e-15);
        }
}

/* Koren and minmod never leave the interval between the two particles, nor turn at an extremum. */
static void limiters_stay_within_the_pair(void **state)
{
    (void)state;
    for (int k = 0; k < 1000; k++) {
        const double s = 4.0 * rand() / RAND_MAX - 2.0, D = 4.0 * rand() / RAND_MAX - 2.0;
        for (int limiter = LIMITER_KOREN; limiter <= LIMITER_MINMOD; limiter++) {
            double h, right;
            steps(D, s, limiter, &h, &right);
            assert_close(right, h, 1e-15);
            assert_true(h * D >= 0.0 && fabs(h) <= fabs(D));
            if ((limiter == LIMITER_MINMOD && s * D <= 0.0) ||
                (limiter == LIMITER_KOREN && (2.0 * s - D) * D <= 0.0))
                assert_true(h == 0.0);
            if (limiter == LIMITER_MINMOD) { /* [2.82-2.83] as printed */
                const double theta = s / D, clip = theta < 0.0 ? 0.0 : theta > 1.0 ? 1.0 : theta;
                assert_close(h, 0.5 * clip * D, 1e-12);
            }
        }
    }
}

/* At a distance of 1, so that velocities times r are velocities; c0 = 10. */
static void solve(double Zl, double ul, double Pl, double Zr, double ur, double Pr, bool low,
                  double *uE, double *PE)
{
    const struct weights z = weigh(vec_all(1.0), vec_all(Zl), vec_all(Zr));
    const struct dissipation d = {.factor = 3.0 / 10.0, .least = low ? 0.0 : 1.0};
    const vec p[2] = {vec_all(Pl), vec_all(Pr)}, v[2] = {vec_all(ul), vec_all(ur)};
    vec u, P;
    star(&d, &z, p, v, &u, &P);
    *uE = u[0];
    *PE = P[0];
}

static void riemann_identities(void **state)
{
    (void)state;
    double u, P;
    solve(10.0, 0.3, 2.0, 10.0, 0.3, 2.0, false, &u, &P); /* equal states: themselves */
    assert_close(u, 0.3, 1e-15);
    assert_close(P, 2.0, 1e-14);
    solve(10.0, 0.3, 2.0, 10.0, -0.3, 2.0, false, &u, &P); /* head on: at rest, P + rho c u */
    assert_close(u, 0.0, 1e-15);
    assert_close(P, 2.0 + 10.0 * 0.3, 1e-14);
    solve(9.0, 0.1, 1.0, 11.0, -0.2, 3.0, false, &u, &P); /* jump conditions of both waves */
    assert_close(P - 1.0, -9.0 * (u - 0.1), 1e-13);
    assert_close(P - 3.0, 11.0 * (u + 0.2), 1e-13);
    solve(10.0, -0.3, 2.0, 10.0, 0.3, 2.0, true, &u, &P); /* parting, low dissipation: no suction */
    assert_close(P, 2.0, 1e-14);
    solve(10.0, 5.0, 2.0, 10.0, -5.0, 2.0, true, &u, &P); /* 3 (ul-ur) > c0 = 10: the full jump */
    assert_close(P, 2.0 + 10.0 * 5.0, 1e-13);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(kernel_integrates_to_one),
                                       cmocka_unit_test(slope_is_the_derivative),
                                       cmocka_unit_test(kernel_sums_on_a_lattice),
                                       cmocka_unit_test(tait_and_its_inverse),
                                       cmocka_unit_test(all_limiters_meet_on_linear_fields),
                                       cmocka_unit_test(limiters_stay_within_the_pair),
                                       cmocka_unit_test(riemann_identities)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
