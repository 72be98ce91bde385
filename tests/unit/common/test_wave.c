/* test_wave.c - exact solutions with a surface or walls: the standing wave's eigenvalue, equations
 * and boundary conditions, channels, patch and drop. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <complex.h>

#include "../../../common/scene/exact.h"

TEST(eigenvalues)
{
    /* Collocation of the original equations (Chebyshev), H = g = 1. */
    static const struct {
        double kH, Re, re, im;
    } known[] = {{0.5 * M_PI, 500.0, -0.014629189, 1.195190510}};
    for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
        const struct wave w =
            wave_create(1.0, 2.0 * M_PI / known[k].kH, 1.0, 1.0 / known[k].Re, 1.0, 0.05);
        assert_true(fabs(creal(w.s) - known[k].re) < 2e-9);
        assert_true(fabs(cimag(w.s) - known[k].im) < 2e-9);
    }
    /* Inviscid limit of the frequency, and deep water's damping 2 nu k^2 (Lamb). */
    const struct wave deep = wave_create(10.0, 1.0, 9.81, 1e-6, 1.0, 0.01);
    assert_true(fabs(cimag(deep.s) / sqrt(9.81 * deep.k) - 1.0) < 1e-4);
    assert_true(fabs(-creal(deep.s) / (2e-6 * deep.k * deep.k) - 1.0) < 2e-3);
}

/* Linear momentum and continuity by differences, in the layers and between them. */
TEST(wave_solves_its_equations)
{
    const struct wave w = wave_create(1.0, 4.0, 1.0, 1.0 / 500.0, 1.0, 0.05);
    const double h = 1e-4, t = 0.7;
    for (int k = 0; k < 20; k++) {
        const double x = 0.3 + 0.07 * k, y = -0.99 + 0.05 * k;
        double u[2], e[2], W[2], n[2], s[2], b[2], a[2], pe, pw, pn, ps, dummy;
        wave_point(&w, x, y, t, u, &dummy, NULL);
        wave_point(&w, x + h, y, t, e, &pe, NULL);
        wave_point(&w, x - h, y, t, W, &pw, NULL);
        wave_point(&w, x, y + h, t, n, &pn, NULL);
        wave_point(&w, x, y - h, t, s, &ps, NULL);
        wave_point(&w, x, y, t - h, b, &dummy, NULL);
        wave_point(&w, x, y, t + h, a, &dummy, NULL);
        assert_true(fabs(e[0] - W[0] + n[1] - s[1]) / (2.0 * h) < 1e-6);
        for (int c = 0; c < 2; c++) {
            const double lap = (e[c] + W[c] + n[c] + s[c] - 4.0 * u[c]) / (h * h);
            const double dp = (c == 0 ? pe - pw : pn - ps) / (2.0 * h);
            const double residual =
                (a[c] - b[c]) / (2.0 * h) + dp + (c == 1 ? 1.0 : 0.0) - w.nu * lap;
            assert_true(fabs(residual) < 2e-6);
        }
    }
    double u[2];
    wave_point(&w, 0.4, -1.0, 0.3, u, NULL, NULL);
    assert_true(fabs(u[0]) < 1e-12 && fabs(u[1]) < 1e-12);
}

static struct scene channel(int field)
{
    struct scene s = {.fluid = {.rho = 1000.0, .nu = 0.1, .gravity = {0.8, 0.0, 0.0}},
                      .domain = {.dim = 2, .max = {1.0, 1.0}, .periodic = {true}},
                      .initial = {.field = field, .U = 1.0, .L = 1.0, .level = LEVEL_TOP}};
    if (field != FIELD_POISEUILLE)
        s.fluid.gravity[0] = 0.0;
    return s;
}

/* Water of real viscosity: its layers are millimetres, cells beyond the crest and
 * the bottom are not. */
TEST(thin_layers_do_not_grow_beyond_the_water)
{
    const struct wave w = wave_create(0.6, 2.0, 9.81, 1e-6, 1000.0, 0.03);
    for (int j = -80; j <= 60; j++) {
        double u[2], vorticity;
        wave_point(&w, 0.7, 0.01 * j, 0.1, u, NULL, &vorticity);
        assert_true(hypot(u[0], u[1]) < 10.0 * 0.03 * cabs(w.s));
    }
}

TEST(channels)
{
    const double y[3] = {0.3, 0.5, 0.0}, wall[3] = {0.0, 1.0, 0.0}, h = 1e-4;
    const double near[3] = {0.3, 0.99, 0.0};
    double u[3], before[3], after[3], above[3], below[3], w;
    for (int field = FIELD_POISEUILLE; field <= FIELD_COUETTE; field++) {
        const struct scene s = channel(field);
        const struct exact e = exact_create(&s);
        exact_point(&e, y, 1e3, u, NULL, NULL);
        assert_true(fabs(u[0] - (field == FIELD_POISEUILLE ? 1.0 : 0.5)) < 1e-12);
        exact_point(&e, wall, 0.4, u, NULL, NULL);
        assert_true(fabs(u[0] - (field == FIELD_POISEUILLE ? 0.0 : 1.0)) < 1e-10);
        exact_point(&e, near, 0.0, u, NULL, &w);
        assert_true(u[0] == 0.0 && w == 0.0);
        const double at[3] = {0.0, 0.3, 0.0}, up[3] = {0.0, 0.3 + h, 0.0}, down[3] = {0.0, 0.3 - h};
        exact_point(&e, at, 0.5, u, NULL, &w);
        exact_point(&e, at, 0.5 - h, before, NULL, NULL);
        exact_point(&e, at, 0.5 + h, after, NULL, NULL);
        exact_point(&e, up, 0.5, above, NULL, NULL);
        exact_point(&e, down, 0.5, below, NULL, NULL);
        assert_true(fabs((after[0] - before[0]) / (2.0 * h) - s.fluid.gravity[0] -
                         0.1 * (above[0] + below[0] - 2.0 * u[0]) / (h * h)) < 1e-5);
        assert_true(fabs(w + (above[0] - below[0]) / (2.0 * h)) < 1e-6);
    }
}

TEST(patch_and_drop)
{
    struct scene s = {.fluid = {.rho = 1.0, .central = 1.0},
                      .domain = {.dim = 2},
                      .initial = {.field = FIELD_PATCH, .U = 1.0, .L = 1.0, .level = LEVEL_TOP}};
    const double centre[3] = {0.0, 0.0, 0.0}, side[3] = {0.5, 0.1, 0.0};
    double u[3], p;
    struct exact e = exact_create(&s);
    exact_point(&e, centre, 0.0, u, &p, NULL);
    assert_true(fabs(p + 0.1473427) < 2e-5);
    exact_point(&e, side, 0.0, u, &p, NULL);
    assert_true(fabs(p) < 1e-12 && fabs(u[0] - 0.1) < 1e-15 && fabs(u[1] + 0.5) < 1e-15);
    s.initial.field = FIELD_DROP;
    e = exact_create(&s);
    exact_point(&e, centre, 0.0, u, &p, NULL);
    assert_true(fabs(p - 1.0) < 1e-15);
    assert_false(exact_at_all_times(&s));
}

/* By collocation in time and depth, t sqrt(g/H) = 0 and 34.5: the integral of w^2 over a wave. */
TEST(enstrophy_of_the_layer)
{
    const struct wave w = wave_create(1.0, 4.0, 1.0, 1.0 / 500.0, 1.0, 0.05);
    assert_close(8.0 * wave_enstrophy(&w, 0.0), 8.564256622 * 0.0025, 1e-6);
    assert_close(8.0 * wave_enstrophy(&w, 34.5), 8.564256622 * 0.0025 * 0.2623700089, 1e-6);
}

/* What stokes.h promises: a divergence-free velocity, v the surface's rate of change for a crest
 * that travels at omega/k, no pressure on the surface, and the weight of the water far below. */
TEST(stokes_wave_travels)
{
    const struct stokes w = stokes_create(1.0, 1.0, 1.0, 0.1);
    const double h = 1e-5;
    double mean = 0.0;
    for (int i = 0; i < 64; i++) {
        const double x = i / 64.0, first = w.a * cos(w.k * x), y = stokes_eta(&w, x);
        double u[2], e[2], W[2], n[2], s[2], p;
        mean += stokes_eta(&w, x);
        stokes_point(&w, x, 0.0, u, NULL);
        const double rate = w.omega / w.k * (w.a * cos(w.k * (x - h)) - first) / h;
        assert_true(fabs(u[1] - rate) < 1e-4);
        stokes_point(&w, x + h, -0.1, e, NULL);
        stokes_point(&w, x - h, -0.1, W, NULL);
        stokes_point(&w, x, -0.1 + h, n, NULL);
        stokes_point(&w, x, -0.1 - h, s, NULL);
        assert_true(fabs(e[0] - W[0] + n[1] - s[1]) / (2.0 * h) < 1e-6);
        stokes_point(&w, x, y - 1e-9, NULL, &p);
        assert_true(fabs(p) < 1e-7);
        stokes_point(&w, x, -2.0, NULL, &p);
        assert_true(fabs(p - 2.0) < 1e-4);
    }
    assert_true(fabs(mean) < 1e-12);
}

/* Pivots that depend on units left the root of a viscous wave with six digits, others in other
 * units. */
TEST(waves_are_the_same_in_other_units)
{
    const double L = 32.0, U = 0.0625, H = 0.17578125, length = 0.48828125,
                 nu = 0.40444735510869156;
    const struct wave a = wave_create(H, length, 9.81, nu, 1000.0, 0.0067);
    const struct wave b =
        wave_create(L * H, L * length, U * U / L * 9.81, L * U * nu, 1.0, L * 0.0067);
    assert_close(cabs(b.s * L / U - a.s) / cabs(a.s), 0.0, 1e-14);
    double u[2], v[2];
    wave_point(&a, 0.1, -0.05, 0.0, u, NULL, NULL);
    wave_point(&b, L * 0.1, L * -0.05, 0.0, v, NULL, NULL);
    for (int k = 0; k < 2; k++)
        assert_close(v[k] / U, u[k], 1e-12 * 0.0067 * cabs(a.s));
}
