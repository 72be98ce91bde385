/* test_steady.c - waves of permanent form: published speeds, still water far from solitary ones,
 * Bernoulli's equation, no divergence, gradients. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/waves/steady.h"

/* c^2 k/g = 1 + e^2 + e^4/2 + e^6/4 - ... in deep water, e = kH/2 (Stokes's expansion). */
TEST(deep_waves_have_stokes_speed)
{
    for (int m = 1; m <= 3; m++) {
        struct steady w;
        const double e = 0.1 * m, k = 2.0 * M_PI, g = 9.81;
        assert_true(steady_create(&w, false, 5.0, 1.0, 2.0 * e / k, 0.0, g, 1000.0));
        const double series = 1.0 + e * e + 0.5 * pow(e, 4) + 0.25 * pow(e, 6);
        assert_close(w.c * w.c * k / g, series, 1.5 * pow(e, 8));
    }
}

/* Speeds from a solution of Babenko's equation (Clamond & Dutykh 2013), residual 1e-13. */
TEST(solitary_waves_have_their_speed)
{
    static const double at[3][2] = {{0.1, 1.048548}, {0.2, 1.094345}, {0.3, 1.137523}};
    for (int m = 0; m < 3; m++) {
        struct steady w;
        double u[2], p;
        assert_true(steady_create(&w, true, 1.0, 0.0, at[m][0], 3.0, 1.0, 1.0));
        assert_close(w.c, at[m][1], 3e-5);
        assert_close(steady_eta(&w, 3.0, 0.0), at[m][0], 1e-10);
        assert_close(steady_eta(&w, 3.0 + 2.0 * w.c, 2.0), at[m][0], 1e-10);
        steady_point(&w, 21.0, -0.5, 0.0, u, &p);
        assert_close(u[0], 0.0, 2e-4);
        assert_close(p, 0.5, 2e-4);
        steady_point(&w, 100.0, -0.5, 0.0, u, &p);
        assert_close(p, 0.5, 1e-12);
    }
}

/* p = 0 on the surface, which moves with the water; div u = 0; none through the bottom; Euler's
 * equation along x, by differences. */
static void judge(const struct steady *w, double depth, double x)
{
    const double h = 1e-4, eta = steady_eta(w, x, 0.0), y = -0.4 * depth;
    double u[2], p, v[4][2], q[4];
    steady_point(w, x, eta, 0.0, u, &p);
    assert_close(p, 0.0, 1e-9);
    const double slope = (steady_eta(w, x + h, 0.0) - steady_eta(w, x - h, 0.0)) / (2.0 * h);
    assert_close(u[1], (u[0] - w->c) * slope, 1e-6);
    steady_point(w, x, -depth, 0.0, u, &p);
    assert_close(u[1], 0.0, 1e-9);
    steady_point(w, x, y, 0.0, u, &p);
    for (int m = 0; m < 4; m++)
        steady_point(w,
                     x + (m == 0   ? h
                          : m == 1 ? -h
                                   : 0.0),
                     y + (m == 2   ? h
                          : m == 3 ? -h
                                   : 0.0),
                     0.0, v[m], q + m);
    const double ux = (v[0][0] - v[1][0]) / (2.0 * h), vy = (v[2][1] - v[3][1]) / (2.0 * h);
    const double uy = (v[2][0] - v[3][0]) / (2.0 * h), px = (q[0] - q[1]) / (2.0 * h);
    assert_close(ux + vy, 0.0, 1e-6);
    assert_close((u[0] - w->c) * ux + u[1] * uy + px / w->rho, 0.0, 1e-6);
    struct steady_slopes of;
    steady_point_slopes(w, x, y, 0.0, u, &p, &of);
    assert_close(of.u[0][0], ux, 1e-6);
    assert_close(of.u[0][1], uy, 1e-6);
    assert_close(of.u[1][0], (v[0][1] - v[1][1]) / (2.0 * h), 1e-6);
    assert_close(of.u[1][1], vy, 1e-6);
    assert_close(of.p[0], px, 1e-6);
    assert_close(of.p[1], (q[2] - q[3]) / (2.0 * h), 1e-6);
    steady_point(w, x + h, eta + 0.3, 0.0, v[0], q);
    steady_point(w, x - h, eta + 0.3, 0.0, v[1], q + 1);
    steady_point_slopes(w, x, eta + 0.3, 0.0, u, &p, &of);
    for (int a = 0; a < 2; a++) { /* above the surface */
        assert_close(of.u[a][0], (v[0][a] - v[1][a]) / (2.0 * h), 1e-6);
        assert_close(of.u[a][1], 0.0, 1e-12);
        assert_close(of.p[a], 0.0, 1e-12);
    }
}

TEST(fields_obey_euler)
{
    struct steady w;
    assert_true(steady_create(&w, false, 1.0, 4.19, 0.27, 0.3, 1.0, 1.0)); /* kd 1.5, ka 0.2 */
    for (int m = 0; m < 9; m++)
        judge(&w, 1.0, 0.3 + 0.5 * m);
    assert_true(steady_create(&w, true, 1.0, 0.0, 0.3, 0.0, 1.0, 1.0));
    for (int m = 0; m < 9; m++)
        judge(&w, 1.0, -2.0 + 0.5 * m);
}

/* What is too high to exist is said so. */
TEST(there_is_a_highest_wave)
{
    struct steady w;
    assert_false(steady_create(&w, false, 5.0, 1.0, 0.15, 0.0, 9.81, 1.0)); /* 0.141 */
    assert_false(steady_create(&w, true, 1.0, 0.0, 0.9, 0.0, 9.81, 1.0));   /* 0.833 */
}
