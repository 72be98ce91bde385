/* test_layer.c - transforms are the sums that they stand for; the potential of steep waves has
 * their velocities from the surface to the bed, deep and shallow; over an uneven bed that of a
 * harmonic function; along a slanted direction of a plane what it has along a line; steady waves
 * keep their speed, height and energy, by the layer and by orders in steepness.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/waves/evolution.h"
#include "../../../common/waves/steady.h"

static void below(double value, double bound, const char *what)
{
    print_message("%s: %.2g (at most %.2g)\n", what, value, bound);
    assert_true(value <= bound);
}

/* Against the sums themselves, both signs, fields side by side. */
TEST(transforms_are_sums)
{
    static const int sizes[] = {1, 2, 6, 10, 36, 60, 90};
    enum { INNER = 2, BATCH = 3, BLOCK = INNER * 2 * BATCH };
    double worst = 0.0;
    assert_int_equal(fft_size(7), 8);
    assert_int_equal(fft_size(97), 100);
    for (int q = 0; q < 7; q++)
        for (int sign = -1; sign < 2; sign += 2) {
            const int n = sizes[q];
            double *z = NEW(double, n *BLOCK), *is = NEW(double, n *BLOCK),
                   *work = NEW(double, n *BLOCK);
            for (int i = 0; i < n * BLOCK; i++)
                is[i] = z[i] = sin(1.7 * i * i);
            struct fft *f = fft_create(n);
            fft_run(f, sign, INNER, BATCH, is, work);
            for (int i = 0; i < n * BLOCK; i++) {
                const int k = i / BLOCK, part = i / BATCH % 2, re = i % BLOCK - part * BATCH;
                double sum = 0.0;
                for (int j = 0; j < n; j++) {
                    const double a = sign * 2.0 * M_PI * (j * k % n) / n, *x = z + j * BLOCK + re;
                    sum += part ? cos(a) * x[BATCH] + sin(a) * x[0]
                                : cos(a) * x[0] - sin(a) * x[BATCH];
                }
                worst = fmax(worst, fabs(sum - is[i]));
            }
            FREE(f, z, is, work);
        }
    below(worst, 1e-12, "transforms");
}

/* eta and phi_s on n points of a steady wave: d phi_s/dx = u + w eta_x, its mode 0 is none. */
static void surface_of(const struct steady *w, const struct wave_grid *g, double *eta, double *phi)
{
    const int n = g->cells;
    double *z = NEW(double, 2 * n), *work = NEW(double, 2 * n);
    for (int i = 0; i < n; i++)
        z[2 * i] = eta[i] = steady_eta(w, g->length[0] * (i % g->n[0]) / g->n[0], 0.0);
    wave_grid_to_modes(g, 1, z, work);
    for (int i = 0; i < n; i++) {
        const double re = z[2 * i], k = g->k[0][i % g->n[0]];
        z[2 * i] = -k * z[2 * i + 1];
        z[2 * i + 1] = k * re;
    }
    wave_grid_to_fields(g, 1, z, work);
    for (int i = 0; i < n; i++) {
        double u[2];
        steady_point(w, g->length[0] * (i % g->n[0]) / g->n[0], eta[i], 0.0, u, NULL);
        z[2 * i] = u[0] + u[1] * z[2 * i];
        z[2 * i + 1] = 0.0;
    }
    wave_grid_to_modes(g, 1, z, work);
    for (int i = 0; i < n; i++) {
        const double re = z[2 * i], k = g->k[0][i % g->n[0]];
        z[2 * i] = k != 0.0 ? z[2 * i + 1] / k : 0.0;
        z[2 * i + 1] = k != 0.0 ? -re / k : 0.0;
    }
    wave_grid_to_fields(g, 1, z, work);
    for (int i = 0; i < n; i++)
        phi[i] = z[2 * i];
    FREE(z, work);
}

struct steep {
    double ka, kd;
    int points;
    double bound; /* ten times what the method's authors' discretisation leaves */
};

/* Largest error of u, w over the crest's speed; and of phi_t, which has -(g eta + |u|^2/2) on the
 * surface and is -c u in a steady wave, over c times it. */
static void check_steep(const struct steep *of)
{
    const double lambda = 2.0 * M_PI, length[2] = {lambda, lambda};
    const int n[2] = {of->points, 1};
    struct steady w;
    assert_true(steady_create(&w, false, of->kd, lambda, 2.0 * of->ka, 0.0, 1.0, 1.0));
    struct wave_grid *g = wave_grid_create(n, length);
    struct sigma_layer *l = layer_create(g, of->kd, layer_height(1.0, of->ka, of->kd), 13);
    double *eta = NEW(double, n[0]), *phi = NEW(double, n[0]), top[2], worst = 0.0, rate = 0.0;
    surface_of(&w, g, eta, phi);
    layer_shape(l, eta);
    const int products = layer_solve(l, phi, 1e-12, false);
    steady_point(&w, 0.0, eta[0], 0.0, top, NULL);
    for (int i = 0; i < n[0]; i++) {
        double u[16], up[16], v[2];
        layer_velocity(l, i, u, up, NULL);
        for (int j = 0; j < l->nodes; j++) {
            steady_point(&w, lambda * i / n[0], eta[i] + l->sigma[j] * l->D[i], 0.0, v, NULL);
            worst = fmax(worst, hypot(u[j] - v[0], up[j] - v[1]));
        }
        phi[i] = -(eta[i] + 0.5 * (u[0] * u[0] + up[0] * up[0]));
    }
    layer_solve(l, phi, 1e-12, false);
    double mean = 0.0;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < n[0]; i++) {
            double v[2];
            steady_point(&w, lambda * i / n[0], eta[i] - 0.5 * l->D[i], 0.0, v, NULL);
            const double is = l->phi[i * l->rows + (l->nodes - 1) / 2] + w.c * v[0];
            mean += pass ? 0.0 : is / n[0];
            rate = fmax(rate, pass ? fabs(is - mean) : 0.0);
        }
    print_message("ka %g kd %g: %d products; ", of->ka, of->kd, products);
    assert_true(products > 0);
    below(worst / top[0], of->bound, "velocities");
    below(rate / (w.c * top[0]), of->bound, "phi_t");
    FREE(eta, phi, l, g);
}

TEST(steep_waves_have_their_velocities)
{
    static const struct steep of[] = {{0.1, 20.0, 64, 5e-9}, {0.2, 20.0, 64, 6e-9},
                                      {0.3, 20.0, 64, 4e-8}, {0.38, 20.0, 128, 9e-5},
                                      {0.1, 1.0, 64, 4e-8},  {0.12, 0.6, 64, 8e-8}};
    for (int k = 0; k < 6; k++)
        check_steep(of + k);
}

/* A wave along the diagonal of a plane has the velocities that it has along a line. */
TEST(planes_turn_lines)
{
    enum { N = 24 };
    const int n[2] = {N, N};
    const double side = 2.0 * M_PI * sqrt(2.0), length[2] = {side, side};
    struct steady w;
    assert_true(steady_create(&w, false, 20.0, 2.0 * M_PI, 0.2, 0.0, 1.0, 1.0));
    struct wave_grid *g = wave_grid_create(n, length);
    struct sigma_layer *l = layer_create(g, 20.0, 1.0, 11);
    double *eta = NEW(double, N *N), *phi = NEW(double, N *N), worst = 0.0, top[2];
    const int line[2] = {N, 1};
    const double long_[2] = {2.0 * M_PI, 1.0};
    struct wave_grid *one = wave_grid_create(line, long_);
    double e[N], p[N];
    surface_of(&w, one, e, p);
    for (int i = 0; i < N * N; i++) { /* (x + y)/sqrt 2 */
        eta[i] = e[(i % N + i / N) % N];
        phi[i] = p[(i % N + i / N) % N];
    }
    layer_shape(l, eta);
    assert_true(layer_solve(l, phi, 1e-10, false) > 0);
    steady_point(&w, 0.0, eta[0], 0.0, top, NULL);
    for (int i = 0; i < N * N; i++) {
        double u[16], up[16], v[16], is[2];
        layer_velocity(l, i, u, up, v);
        for (int j = 0; j < l->nodes; j++) {
            steady_point(&w, 2.0 * M_PI * (i % N + i / N) / N, eta[i] + l->sigma[j] * l->D[i], 0.0,
                         is, NULL);
            const double along = sqrt(0.5) * is[0];
            worst = fmax(worst, fabs(u[j] - along) + fabs(v[j] - along) + fabs(up[j] - is[1]));
        }
    }
    below(worst / top[0], 1e-6, "plane");
    FREE(eta, phi, l, g, one);
}

struct kept {
    double ka, kd;
    int points, modes, nodes, order, periods;
    double speed, energy; /* bounds: ten times what these methods leave with as many points */
};

/* c, the energy and the first harmonic after some periods, 60 steps each. */
static void check_kept(const struct kept *of)
{
    const double lambda = 2.0 * M_PI, length[2] = {lambda, lambda};
    const int n[2] = {of->points, 1};
    struct steady w;
    assert_true(steady_create(&w, false, of->kd, lambda, 2.0 * of->ka, 0.0, 1.0, 1.0));
    const struct evolution_spec spec = {.g = 1.0,
                                        .depth = of->kd,
                                        .dt = lambda / w.c / 60.0,
                                        .highest = of->modes + 0.5,
                                        .height = layer_height(1.0, of->ka, of->kd),
                                        .nodes = of->nodes,
                                        .order = of->order};
    struct evolution *e = evolution_create(&spec, wave_grid_create(n, length));
    double *eta = NEW(double, n[0]), *phi = NEW(double, n[0]);
    surface_of(&w, e->grid, eta, phi);
    evolution_start(e, eta, phi);
    double first[2], energy = 0.0;
    for (int k = 0; k <= 60 * of->periods; k++) {
        const double *z = e->state + 2, *m = e->state + 2 * (n[0] - 1); /* eta's mode 1 */
        const double now[2] = {0.5 * (z[0] + m[0]), 0.5 * (z[1] - m[1])};
        if (k == 0)
            memcpy(first, now, sizeof now);
        if (k == 60 * of->periods) {
            below(fabs(atan2(now[0] * first[1] - now[1] * first[0],
                             now[0] * first[0] + now[1] * first[1])) /
                      (lambda * of->periods),
                  of->speed, "speed");
            below(fabs(hypot(now[0], now[1]) / hypot(first[0], first[1]) - 1.0), of->energy,
                  "height");
        }
        assert_true(evolution_step(e));
        energy = k == 0 ? e->energy : energy;
    }
    print_message("ka %g kd %g order %d: %.1f products a stage; ", of->ka, of->kd, of->order,
                  e->products / (240.0 * of->periods + 4.0));
    below(fabs(e->energy / energy - 1.0), of->energy, "energy");
    FREE(eta, phi, e);
}

TEST(steady_waves_stay_what_they_are)
{
    static const struct kept of[] = {{0.2, 20.0, 32, 12, 9, 0, 4, 1e-6, 9e-6},
                                     {0.3, 20.0, 48, 16, 9, 0, 4, 4e-6, 7e-5},
                                     {0.35, 20.0, 64, 24, 9, 0, 4, 7e-6, 8e-5},
                                     {0.12, 0.6, 64, 20, 9, 0, 4, 3e-6, 3e-6}};
    for (int k = 0; k < (SANITIZED ? 1 : 4); k++)
        check_kept(of + k);
}

TEST(orders_in_steepness_keep_them_too)
{
    static const struct kept of[] = {{0.1, 20.0, 50, 8, 9, 5, 5, 1.3e-6, 1.6e-6},
                                     {0.2, 20.0, 50, 8, 9, 5, 5, 7.6e-5, 3.8e-5},
                                     {0.3, 20.0, 96, 12, 9, 7, 5, 7.5e-5, 6.3e-5},
                                     {0.1, 1.0, 96, 16, 9, 5, 5, 5e-6, 1e-5}};
    for (int k = 0; k < (SANITIZED ? 1 : 4); k++)
        check_kept(of + k);
}
