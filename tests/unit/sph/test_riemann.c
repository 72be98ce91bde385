/* test_riemann.c - states at the middle of a pair and the Riemann problem between them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/riemann.h"
#include "../../../sph/pairs/riemann_exact.h"
#include "../../../sph/particles/eos.h"

static const struct dissipation full = {.factor = 0.3, .least = 1.0};
static const struct dissipation low = {.factor = 0.3, .least = 0.0}; /* c0 = 10 m/s */

/* The same with scalars; u: normal velocities. */
static void solve(const struct dissipation *d, double Zi, double Zj, double ui, double uj,
                  double pi, double pj, double *uE, double *pE)
{
    const double r = 0.37; /* must not matter */
    const struct weights z = weigh(vec_all(r), vec_all(Zi), vec_all(Zj));
    const vec p[2] = {vec_all(pi), vec_all(pj)}, v[2] = {vec_all(r * ui), vec_all(r * uj)};
    vec vE, P;
    star(d, &z, p, v, vec_all(0.0), &vE, &P);
    *uE = vE[LANES - 1] / r;
    *pE = P[LANES - 1];
}

TEST(equal_states_stay)
{
    double uE, pE;
    solve(&full, 1e4, 1e4, 0.7, 0.7, 123.0, 123.0, &uE, &pE);
    assert_close(uE, 0.7, 1e-14);
    assert_close(pE, 123.0, 1e-11);
    solve(&low, 1e4, 1e4, 0.7, 0.7, 123.0, 123.0, &uE, &pE);
    assert_close(uE, 0.7, 1e-14);
    assert_close(pE, 123.0, 1e-11);
}

TEST(symmetric_collision_is_rho_c_u)
{
    double uE, pE;
    solve(&full, 1e4, 1e4, 0.5, -0.5, 100.0, 100.0, &uE, &pE);
    assert_close(uE, 0.0, 1e-14);
    assert_close(pE, 100.0 + 1e4 * 0.5, 1e-9);
}

/* p_E - p_i = -Z_i (u_E - u_i), p_E - p_j = Z_j (u_E - u_j). */
TEST(star_state_lies_on_both_waves)
{
    const double Zi = 1.1e4, Zj = 0.8e4, ui = 0.9, uj = 0.4, pi = 50.0, pj = 900.0;
    double uE, pE;
    solve(&full, Zi, Zj, ui, uj, pi, pj, &uE, &pE);
    assert_close(pE - pi, -Zi * (uE - ui), 1e-8);
    assert_close(pE - pj, Zj * (uE - uj), 1e-8);
}

/* Dissipation of p: none where particles part, (3/c0) jump^2 Z/2 for slow approach, full for a fast
 * one. */
TEST(low_dissipation_is_bounded)
{
    double uE, pE;
    solve(&low, 1e4, 1e4, -0.5, 0.5, 100.0, 100.0, &uE, &pE);
    assert_close(pE, 100.0, 1e-9);
    solve(&low, 1e4, 1e4, 0.5, -0.5, 100.0, 100.0, &uE, &pE);
    assert_close(pE, 100.0 + 0.5e4 * 0.3, 1e-9);
    solve(&low, 1e4, 1e4, 2.5, -2.5, 100.0, 100.0, &uE, &pE);
    assert_close(pE, 100.0 + 0.5e4 * 5.0, 1e-9);
}

/* States of third order at the middle of a pair have 2/3 of what the mean slope exceeds the
 * difference by for their jump; its wave is in p_E, and none of it where the dissipation of the
 * bounded states is whole. */
TEST(even_dissipation_is_that_of_third_order)
{
    const double even = 0.1, D = 0.3, slope[2] = {0.5, -0.2};
    const struct dissipation calm = {.factor = 0.0}, all = {.factor = 0.0, .least = 1.0};
    const struct weights z = weigh(vec_all(1.0), vec_all(1e4), vec_all(1e4));
    vec left = vec_all(0.7), right = left + D, vE, P[3];
    const vec p[2] = {vec_all(50.0), vec_all(50.0)}, v[2] = {left, right};
    const vec jump = vec_all(even * 2.0 / 3.0 * (0.5 * (slope[0] + slope[1]) - D));
    star(&calm, &z, p, v, jump, &vE, P);
    star(&calm, &z, p, v, vec_all(0.0), &vE, P + 1);
    star(&all, &z, p, v, jump, &vE, P + 2);
    reconstruct(&left, &right, vec_all(slope[0]), vec_all(slope[1]), LIMITER_NONE, 0.0);
    assert_close(P[0][0], 50.0 + even * 0.5e4 * (left[0] - right[0]), 1e-9);
    assert_close(P[1][0], 50.0, 1e-12);
    assert_close(P[2][LANES - 1], 50.0 - 0.5e4 * D, 1e-9);
}

static void states_of(double *left, double *right, double s_left, double s_right, int limiter)
{
    vec l = vec_all(*left), r = vec_all(*right);
    const vec sl = vec_all(s_left), sr = vec_all(s_right);
    if (limiter == LIMITER_KOREN)
        reconstruct(&l, &r, sl, sr, LIMITER_KOREN, 0.0);
    else if (limiter == LIMITER_MINMOD)
        reconstruct(&l, &r, sl, sr, LIMITER_MINMOD, 0.0);
    else
        reconstruct(&l, &r, sl, sr, LIMITER_NONE, 0.0);
    *left = l[0];
    *right = r[LANES - 1];
}

TEST(linear_fields_meet_in_the_middle)
{
    for (int limiter = LIMITER_KOREN; limiter <= LIMITER_NONE; limiter++)
        for (double D = -2.0; D <= 2.0; D += 0.5) {
            double left = 3.0, right = 3.0 + D;
            states_of(&left, &right, D, D, limiter);
            assert_close(left, 3.0 + 0.5 * D, 1e-14);
            assert_close(right, left, 1e-14);
        }
}

/* [2.82-2.83] as printed, and Koren's form: psi(r) b/2, psi = max(0, min(2r, (1 + 2r)/3, 2)), r =
 * D/b, b = 2s - D. */
static double step(double D, double s, int limiter)
{
    if (limiter == LIMITER_NONE)
        return (2.0 * s + D) / 6.0;
    if (limiter == LIMITER_MINMOD) {
        const double t = s / D;
        return 0.5 * (fmin(0.0, fmax(1.0, t)) + fmax(0.0, fmin(1.0, t))) * D;
    }
    const double b = 2.0 * s - D, r = D / b;
    return 0.5 * b * fmax(0.0, fmin(fmin(2.0 * r, (1.0 + 2.0 * r) / 3.0), 2.0));
}

TEST(limiters_are_the_printed_ones)
{
    for (int limiter = LIMITER_KOREN; limiter <= LIMITER_NONE; limiter++)
        for (double D = -1.05; D < 1.1; D += 0.1)
            for (double s = -3.01; s < 3.1; s += 0.07) {
                double left = 0.2, right = 0.2 + D;
                states_of(&left, &right, s, 0.5 * s, limiter);
                assert_close(left, 0.2 + step(D, s, limiter), 1e-14);
                assert_close(right, 0.2 + D - step(D, 0.5 * s, limiter), 1e-14);
            }
}

/* A parabola through its exact slopes: third order, so exact at the middle where no bound acts. */
TEST(koren_is_third_order)
{
    const double curvature = 0.1; /* f(x) = x + curvature x^2/2 in cell averages: b, D = 1 -+ ... */
    double left = 0.0, right = 1.0 + 0.5 * curvature;
    const double D = right, s = 1.0; /* f'(0) = 1, so b = 2s - D = 1 - curvature/2 */
    states_of(&left, &right, s, 1.0 + curvature, LIMITER_KOREN);
    assert_close(left, (2.0 * s + D) / 6.0, 1e-15);
    assert_close(right, D - (2.0 * (1.0 + curvature) + D) / 6.0, 1e-15);
}

/* Both sides of a parabola meet wherever its extremum is, and pass the bounds by no more than the
 * slack. */
TEST(slack_keeps_extrema_smooth)
{
    const double a = 0.3, slack = 0.2;
    for (double x = -1.0; x <= 0.0; x += 0.1) { /* f = a x^2 at x and x + 1 */
        vec left = vec_all(a * x * x), right = vec_all(a * (x + 1.0) * (x + 1.0));
        const vec sl = vec_all(2.0 * a * x), sr = vec_all(2.0 * a * (x + 1.0));
        reconstruct(&left, &right, sl, sr, LIMITER_KOREN, slack);
        assert_close(left[0], right[0], 1e-15);
    }
    for (double s = -5.0; s <= 5.0; s += 0.1) {
        vec left = vec_all(-1.0), right = vec_all(2.0);
        vec up = left, down = left, over = left + 1e-13, under = left - 1e-13;
        reconstruct(&up, &over, vec_all(s), vec_all(s), LIMITER_KOREN, slack);
        reconstruct(&down, &under, vec_all(s), vec_all(s), LIMITER_KOREN, slack);
        assert_close(up[0], down[0], 1e-12); /* no step where the difference changes its sign */
        reconstruct(&left, &right, vec_all(s), vec_all(-s), LIMITER_KOREN, slack);
        assert_true(left[0] >= -1.0 - slack && left[0] <= 2.0 + slack);
        assert_true(right[0] >= -1.0 - slack && right[0] <= 2.0 + slack);
    }
}

TEST(no_bounded_state_overshoots)
{
    for (int limiter = LIMITER_KOREN; limiter <= LIMITER_MINMOD; limiter++)
        for (double s = -5.0; s <= 5.0; s += 0.1) {
            double left = -1.0, right = 2.0;
            states_of(&left, &right, s, -s, limiter);
            assert_true(left >= -1.0 && left <= 2.0 && right >= -1.0 && right <= 2.0);
            left = right = 4.0;
            states_of(&left, &right, s, -s, limiter);
            assert_true(left == 4.0 && right == 4.0);
        }
}

TEST(pressure_is_the_scalar_one)
{
    const double rho0 = 1000.0, c0 = 10.0;
    for (double rho = 900.0; rho < 1100.0; rho += 7.0) {
        const struct tait stiff = {.rho0_1 = 1.0 / rho0,
                                   .B = rho0 * c0 * c0 / 7.0,
                                   .at0 = rho0 * c0 * c0 / 7.0,
                                   .Z0 = rho0 * c0};
        const struct tait soft = {
            .rho0_1 = 1.0 / rho0, .B = rho0 * c0 * c0, .at0 = rho0 * c0 * c0, .Z0 = rho0 * c0};
        assert_close(pressure(&stiff, vec_all(rho), 7)[0], eos_p(rho, rho0, c0, 7.0), 1e-9);
        assert_close(pressure(&soft, vec_all(rho), 1)[0], eos_p(rho, rho0, c0, 1.0), 1e-9);
        assert_close(impedance(&stiff, vec_all(rho), 7)[0], rho * eos_c(rho, rho0, c0, 7.0), 1e-9);
        assert_close(impedance(&soft, vec_all(rho), 1)[0], rho * c0, 1e-9);
    }
}

/* Gas of the exact problems. */
static struct tait gas(int gamma)
{
    const double rho0 = 1000.0, c0 = 10.0, B = rho0 * c0 * c0 / gamma;
    return (struct tait){.rho0_1 = 1.0 / rho0, .B = B, .at0 = B, .Z0 = rho0 * c0, .c0 = c0};
}

/* Star state between densities of[0] and of[1], velocities u[0] and u[1]; the linear one, too. */
static void solve_exactly(int gamma, const double of[2], const double u[2], double star_state[2],
                          double linear[2])
{
    const double r = 0.37;
    const struct tait e = gas(gamma);
    const vec rho[2] = {vec_all(of[0]), vec_all(of[1])},
              v[2] = {vec_all(r * u[0]), vec_all(r * u[1])};
    const vec p[2] = {pressure(&e, rho[0], gamma), pressure(&e, rho[1], gamma)};
    const vec x[2] = {rho[0] * e.rho0_1, rho[1] * e.rho0_1};
    const struct weights z =
        weigh(vec_all(r), impedance(&e, rho[0], gamma), impedance(&e, rho[1], gamma));
    vec vE, P;
    star(&full, &z, p, v, vec_all(0.0), &vE, &P);
    linear[0] = vE[0] / r;
    linear[1] = P[0];
    add_exact(&e, &z, x, v, gamma, &vE, &P);
    star_state[0] = vE[LANES - 1] / r;
    star_state[1] = P[LANES - 1];
}

/* What of the wave between (rho, u) and the star state is not kept, over c0; the wave runs against
 * the axis from the state left of it, along it from the right (side = 1). Shocks keep mass and
 * momentum, rarefactions u + 2 c/(gamma - 1), or u + c log rho with gamma = 1. */
static double lost(int gamma, int side, double rho, double u, const double star_state[2])
{
    const double rho0 = 1000.0, c0 = 10.0, sign = side ? -1.0 : 1.0;
    const double end = eos_rho(star_state[1], rho0, c0, gamma), uE = star_state[0];
    if (end <= rho && gamma == 1)
        return (u - uE) / c0 + sign * log(rho / end);
    if (end <= rho)
        return (u - uE + sign / 3.0 * (eos_c(rho, rho0, c0, 7.0) - eos_c(end, rho0, c0, 7.0))) / c0;
    const double speed = (end * uE - rho * u) / (end - rho), flux = rho * (u - speed);
    assert_true(sign * flux > 0.0);
    return (eos_p(rho, rho0, c0, gamma) + flux * (u - uE) - star_state[1]) / (rho0 * c0 * c0);
}

TEST(exact_star_state_keeps_what_waves_keep)
{
    for (int gamma = 1; gamma <= 7; gamma += 6)
        for (double first = 950.0; first < 1100.0; first += 31.0)
            for (double second = 960.0; second < 1100.0; second += 29.0)
                for (double jump = -2.0; jump < 8.0; jump += 0.7) {
                    const double rho[2] = {first, second}, u[2] = {1.0 + jump, 1.0};
                    double E[2], linear[2];
                    solve_exactly(gamma, rho, u, E, linear);
                    assert_close(lost(gamma, 0, rho[0], u[0], E), 0.0, 1e-9);
                    assert_close(lost(gamma, 1, rho[1], u[1], E), 0.0, 1e-9);
                }
}

/* Both agree to first order: half the jump, a quarter of the difference. */
TEST(linear_star_state_errs_to_second_order)
{
    for (int gamma = 1; gamma <= 7; gamma += 6) {
        double off[3][2];
        for (int k = 0; k < 3; k++) {
            const double half = pow(0.5, k), rho[2] = {1000.0 + 4.0 * half, 1000.0};
            const double u[2] = {0.3 * half, 0.0};
            double E[2], linear[2];
            solve_exactly(gamma, rho, u, E, linear);
            for (int c = 0; c < 2; c++)
                off[k][c] = fabs(E[c] - linear[c]);
        }
        assert_true(off[0][1] > 1.0); /* Pa */
        for (int k = 0; k < 2; k++)
            for (int c = 0; c < 2; c++)
                assert_true(off[k + 1][c] <= 0.3 * off[k][c]);
    }
}

/* In a mirror the two change places and signs of velocity; states that part faster than the gas
 * can follow, 2 (2 c0)/(gamma - 1), leave less than a hundredth of its density and finite values.
 */
TEST(exact_star_state_has_a_mirror_and_a_vacuum)
{
    const double rho[2] = {1030.0, 990.0}, back[2] = {990.0, 1030.0}, u[2] = {0.7, -0.9};
    const double turned[2] = {0.9, -0.7}, away[2] = {-7.0, 7.0};
    double E[2], mirror[2], linear[2];
    solve_exactly(7, rho, u, E, linear);
    solve_exactly(7, back, turned, mirror, linear);
    assert_close(mirror[0], -E[0], 1e-12);
    assert_close(mirror[1], E[1], 1e-8);
    solve_exactly(7, rho, away, E, linear);
    assert_true(isfinite(E[0]));
    assert_close(E[1], -1000.0 * 100.0 / 7.0, 1e-6);
}
