/* test_exact.c - the exact solutions solve the equations: divergence, gradient, averages,
 * Navier-Stokes, balance of faces. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/scene/exact.h"
enum { POINTS = 50, PRESSURE = 3, VORTICITY = 4 };

/* All of the fields, rho and nu not 1. two_modes is carried by a velocity. */
static struct exact field(int which, double nu)
{
    struct scene s = {
        .fluid = {.rho = 1.7, .nu = nu}, .domain = {.dim = 2}, .initial = {.U = 1.3, .L = 0.8}};
    s.initial.field = which;
    if (which != FIELD_TAYLOR_GREEN) {
        s.initial.velocity[0] = 0.4;
        s.initial.velocity[1] = -0.7;
    }
    return exact_create(&s);
}

static const int all[] = {FIELD_REST, FIELD_UNIFORM, FIELD_TAYLOR_GREEN, FIELD_TWO_MODES};

static void somewhere(double *x, double *t)
{
    for (int a = 0; a < 3; a++)
        x[a] = 2.0 * rand() / RAND_MAX - 1.0;
    *t = 0.5 * rand() / RAND_MAX;
}

/* u, v, w (0 .. 2), pressure or vorticity. */
static double at(const struct exact *e, int what, const double *x, double t)
{
    double u[3], p, w;
    exact_point(e, x, t, u, &p, &w);
    return what < PRESSURE ? u[what] : what == PRESSURE ? p : w;
}

/* d/dx_b by central differences of fourth order; b = 3: d/dt. */
static double slope(const struct exact *e, int what, const double *x, double t, int b)
{
    static const double weight[] = {8.0, -1.0};
    const double h = 1e-3;
    double sum = 0.0;
    for (int k = 1; k <= 2; k++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double y[3] = {x[0], x[1], x[2]};
            if (b < 3)
                y[b] += sign * k * h;
            sum += sign * weight[k - 1] * at(e, what, y, b < 3 ? t : t + sign * k * h);
        }
    return sum / (12.0 * h);
}

static double laplace(const struct exact *e, int what, const double *x, double t)
{
    static const double weight[] = {-30.0, 16.0, -1.0};
    const double h = 2e-3;
    double sum = 0.0;
    for (int a = 0; a < 3; a++)
        for (int k = -2; k <= 2; k++) {
            double y[3] = {x[0], x[1], x[2]};
            y[a] += k * h;
            sum += weight[abs(k)] * at(e, what, y, t);
        }
    return sum / (12.0 * h * h);
}

TEST(velocity_is_free_of_divergence)
{
    double x[3], t, g[3][3];
    for (int f = 0; f < 4; f++) {
        const struct exact e = field(all[f], 0.01);
        for (int i = 0; i < POINTS; i++) {
            somewhere(x, &t);
            exact_gradient(&e, x, t, g);
            assert_close(g[0][0] + g[1][1] + g[2][2], 0.0, 1e-12);
            assert_close(slope(&e, 0, x, t, 0) + slope(&e, 1, x, t, 1), 0.0, 1e-5);
        }
    }
}

TEST(gradient_and_vorticity_are_slopes_of_velocity)
{
    double x[3], t, g[3][3], most = 0.0;
    for (int f = 0; f < 4; f++) {
        const struct exact e = field(all[f], 0.01);
        for (int i = 0; i < POINTS; i++) {
            somewhere(x, &t);
            exact_gradient(&e, x, t, g);
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++) {
                    assert_close(g[a][b], slope(&e, a, x, t, b), 1e-5);
                    most = fmax(most, fabs(g[a][b]));
                }
            assert_close(at(&e, VORTICITY, x, t), g[1][0] - g[0][1], 1e-12);
        }
    }
    assert_true(most > 5.0); /* there was something to see */
}

/* rho (du/dt + u.grad u) + grad p - rho nu lap u, whose terms are of order 20. */
TEST(fields_solve_navier_stokes)
{
    double x[3], t;
    for (int f = 0; f < 4; f++)
        for (int viscous = 0; viscous < 2; viscous++) {
            const struct exact e = field(all[f], viscous ? 0.02 : 0.0);
            for (int i = 0; i < POINTS; i++) {
                somewhere(x, &t);
                for (int a = 0; a < 2; a++) {
                    const double carried = at(&e, 0, x, t) * slope(&e, a, x, t, 0) +
                                           at(&e, 1, x, t) * slope(&e, a, x, t, 1);
                    const double residual =
                        e.rho * (slope(&e, a, x, t, 3) + carried - e.nu * laplace(&e, a, x, t)) +
                        slope(&e, PRESSURE, x, t, a);
                    assert_close(residual, 0.0, 2e-4);
                }
            }
        }
}

/* Gauss' rule of 3 points on 12 x 12 parts: order 6. */
static double mean(const struct exact *e, int what, const double *x, const double *h, double t)
{
    enum { N = 12 };
    static const double place[] = {-0.7745966692414834, 0.0, 0.7745966692414834},
                        weight[] = {5, 8, 5};
    double sum = 0.0;
    for (int i = 0; i < 3 * N; i++)
        for (int j = 0; j < 3 * N; j++) {
            const double y[3] = {x[0] + h[0] * ((i / 3 + 0.5 + 0.5 * place[i % 3]) / N - 0.5),
                                 x[1] + h[1] * ((j / 3 + 0.5 + 0.5 * place[j % 3]) / N - 0.5),
                                 x[2]};
            sum += weight[i % 3] * weight[j % 3] * at(e, what, y, t);
        }
    return sum / (18.0 * 18.0 * N * N);
}

TEST(averages_are_those_of_fine_quadrature)
{
    static const double sides[3][3] = {{0.3, 0.17, 0.2}, {0.05, 0.4, 0.1}, {0.8, 0.8, 0.8}};
    double x[3], t, u[3], p, w;
    for (int f = 0; f < 4; f++) {
        const struct exact e = field(all[f], 0.01);
        for (int i = 0; i < 9; i++) {
            const double *h = sides[i % 3];
            somewhere(x, &t);
            exact_average(&e, x, h, t, u, &p, &w);
            for (int a = 0; a < 3; a++)
                assert_close(u[a], mean(&e, a, x, h, t), 1e-8);
            assert_close(p, mean(&e, PRESSURE, x, h, t), 1e-8);
            assert_close(w, mean(&e, VORTICITY, x, h, t), 1e-7);
            if (i % 3 == 2) /* whole waves: means vanish */
                assert_close(p, 0.0, 1e-12);
            for (int n = 0; n < 3; n++) {
                double face[3] = {h[0], h[1], h[2]};
                face[n] = 0.0;
                exact_face(&e, x, h, n, t, u);
                for (int a = 0; a < 3; a++)
                    assert_close(u[a], mean(&e, a, x, face, t), 1e-8);
            }
        }
    }
}

/* What flows into a cell flows out. */
TEST(averages_of_faces_balance)
{
    const double h[3] = {0.3, 0.17, 1.0};
    double x[3], t, u[3], out = 0.0;
    const struct exact e = field(FIELD_TWO_MODES, 0.01);
    for (int i = 0; i < POINTS; i++, out = 0.0) {
        somewhere(x, &t);
        for (int a = 0; a < 2; a++)
            for (int sign = -1; sign <= 1; sign += 2) {
                double y[3] = {x[0], x[1], x[2]};
                y[a] += 0.5 * sign * h[a];
                exact_face(&e, y, h, a, t, u);
                out += sign * u[a] * h[1 - a];
            }
        assert_close(out, 0.0, 1e-13);
    }
}

static struct exact crossed_wave(void)
{
    const struct scene s = {
        .fluid = {.rho = 1.7, .nu = 0.02, .gravity = {0.0, -1.0, 0.0}},
        .domain = {.dim = 3, .max = {2.0, 1.25, 1.5}},
        .initial = {
            .field = FIELD_STANDING_WAVE, .L = 4.0, .L_z = 3.0, .amplitude = 0.5, .level = 1.0}};
    return exact_create(&s);
}

/* cos kx cos kz of the still layer 0 < y < 1: the linearised equations, no flow through the planes
 * of symmetry, none at the bottom. */
TEST(crossed_waves_solve_the_linearised_equations)
{
    const struct exact e = crossed_wave();
    double x[3], t, most = 0.0, period, rate;
    for (int i = 0; i < POINTS; i++) {
        somewhere(x, &t);
        x[1] = 0.5 + 0.45 * x[1];
        assert_close(slope(&e, 0, x, t, 0) + slope(&e, 1, x, t, 1) + slope(&e, 2, x, t, 2), 0.0,
                     1e-8);
        assert_close(at(&e, VORTICITY, x, t), slope(&e, 1, x, t, 0) - slope(&e, 0, x, t, 1), 1e-7);
        for (int a = 0; a < 3; a++) {
            const double inertia = slope(&e, a, x, t, 3), weight = a == 1 ? 1.0 : 0.0;
            assert_close(e.rho * (inertia - e.nu * laplace(&e, a, x, t) + weight) +
                             slope(&e, PRESSURE, x, t, a),
                         0.0, 1e-6);
            most = fmax(most, fabs(inertia));
            for (int n = 0; n < 3; n++) {
                double y[3] = {x[0], x[1], x[2]};
                y[n] = n == 0 ? 2.0 : n == 1 ? 0.0 : 1.5;
                if (n == a)
                    assert_close(at(&e, a, y, t), 0.0, 1e-12);
            }
        }
    }
    assert_true(most > 0.1);
    assert_true(exact_oscillation(&e, &period, &rate));
    assert_close(e.wave.k, 2.0 * M_PI * hypot(1.0 / 4.0, 1.0 / 3.0), 1e-12);
}

/* Midpoint rule over the symmetric piece; the vorticity has the components of x and z. */
TEST(enstrophy_of_crossed_waves_is_that_of_their_vorticity)
{
    enum { N = 24, M = 400 };
    const struct exact e = crossed_wave();
    double sum = 0.0;
    for (int i = 0; i < N * N * M; i++) {
        const double x[3] = {2.0 * (i % N + 0.5) / N, (i / (N * N) + 0.5) / M,
                             1.5 * (i / N % N + 0.5) / N};
        double g[3][3];
        exact_gradient(&e, x, 0.3, g);
        const double w[3] = {g[2][1] - g[1][2], g[0][2] - g[2][0], g[1][0] - g[0][1]};
        assert_close(w[1], 0.0, 1e-8);
        sum += 0.5 * (w[0] * w[0] + w[2] * w[2]) * 3.0 / (N * N * M);
    }
    assert_close(
        exact_enstrophy(&e, (const double[]){0.0, 0.0, 0.0}, (const double[]){3.0, 1.0, 1.0}, 0.3) /
            sum,
        1.0, 1e-3);
}
