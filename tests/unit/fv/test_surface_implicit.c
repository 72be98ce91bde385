/* test_surface_implicit.c - a free surface with bdf2 and newton: still water stays still, waves
 * swing as theory says at steps that rk3 cannot take (five cells of the wave's way, viscosity of 50
 * h^2/dt, cells of aspect 100), columns fall, currents pass openings.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/operators/flow_measures.h"
#include "surface_case.h"

/* Upright, askew over graded rows, in 3D: the surface cuts the cells in all ways; bdf2, newton,
 * newton with sound. */
TEST(still_water_stays)
{
    static const char *const of[3][3] = {
        {"fluid.gravity=(0,-9.81)", "fv.cells=(24,20)", "fv.graded=(0,0)"},
        {"fluid.gravity=(2.9,-9.81)", "fv.cells=(24,20)", "fv.graded=(0.75,7)"},
        {"fluid.gravity=(2.9,1.3,-9.81)", "fv.cells=(12,10,16)", "domain.dim=3"}};
    for (int k = 0; k < 9; k++) {
        struct fv_case c;
        const char *const *o = of[k / 3];
        const struct scene_shape shape = {.form = SHAPE_BELOW, .level = k < 6 ? 0.4123 : 0.2};
        struct fv *s = start(&c, MPI_COMM_WORLD,
                             (const char *const[]){SURFACE, o[0], o[1], o[2], k % 3 ? NEWTON : BDF2,
                                                   k % 3 == 2 ? "fv.c0=20" : NULL, NULL},
                             &shape, WALL_NO_SLIP);
        assert_true(fv_case_run(&c, 5, 10.0));
        print_message("still water: %.3g m/s\n", fmax(s->max.u[0], s->max.u[1]));
        for (int a = 0; a < s->dim; a++)
            assert_close(s->max.u[a], 0.0, 1e-10);
        fv_free(&c.s);
    }
}

/* Errors of period and damping over most of two periods; the volume is kept. */
static void oscillation(const char *cells, const char *graded, const char *integrator,
                        const char *cfl, const char *nu, double *T, double *r)
{
    struct fv_case c;
    double period, rate;
    struct fv *s = start(&c, MPI_COMM_WORLD,
                         (const char *const[]){WAVE, cells, graded, integrator, cfl, nu, NULL},
                         NULL, WALL_NO_SLIP);
    assert_true(exact_oscillation(&s->exact, &period, &rate));
    assert_true(fv_case_run(&c, SANITIZED ? 5 : 10000, 1.9 * period));
    *T = fit_period(&s->surface->oscillation) / period - 1.0;
    *r = fit_rate(&s->surface->oscillation) / rate - 1.0;
    double h = s->b.h[1];
    print_message("wave, %s %s %s: c dt/h %.2g, nu dt/h^2 %.2g, %d steps: period %.3g, damping "
                  "%.3g\n",
                  cells, integrator, graded, 4.0 / period * s->step.dt / h,
                  s->nu * s->step.dt / (h * h), (int)c.run.step, *T, *r);
    assert_close(surface_volume(s) / s->surface->volume0, 1.0, 1e-10);
    fv_free(&c.s);
}

TEST(waves_swing_as_theory_says)
{
    double T, r;
    oscillation("fv.cells=(32,40)", "fv.graded=(0,0)", BDF2, "fv.cfl=0.5", "fluid.nu=2e-3", &T, &r);
    if (!SANITIZED) {
        assert_close(T, 0.0, 0.002);
        assert_close(r, 0.0, 0.03);
    }
    oscillation("fv.cells=(16,24)", "fv.graded=(1.1,8)", NEWTON, "fv.cfl=0.7", "fluid.nu=2e-3", &T,
                &r);
    if (SANITIZED)
        return;
    assert_close(T, 0.0, 0.005);
    oscillation("fv.cells=(32,40)", "fv.graded=(0,0)", NEWTON, "fv.cfl=1.16", "fluid.nu=2e-3", &T,
                &r);
    assert_close(T, 0.0, 0.002);
    assert_close(r, 0.0, 0.03);
    oscillation("fv.cells=(16,40)", "fv.graded=(0,0)", NEWTON, "fv.cfl=1.5", "fluid.nu=0.05", &T,
                &r);
    assert_close(T, 0.0, 0.03);
    assert_close(r, 0.0, 0.1); /* eleven steps a period */
    oscillation("fv.cells=(8,128)", "fv.graded=(0,0)", NEWTON, "fv.cfl=0.7", "fluid.nu=2e-3", &T,
                &r);
    assert_close(T, 0.0, 0.03); /* eight cells a length */
}

/* s: period of a wave of 4 m on 1 m of water by newton, g 1 m/s^2, with this speed of sound. */
static double period_with_sound(const char *cells, const char *graded, const char *c0)
{
    struct fv_case c;
    struct fv *s = start(
        &c, MPI_COMM_WORLD,
        (const char *const[]){WAVE, cells, graded, NEWTON, "fv.cfl=0.3", "fluid.nu=2e-3", c0, NULL},
        NULL, WALL_SLIP);
    assert_true(fv_case_run(&c, SANITIZED ? 5 : 10000, 10.0));
    const double period = fit_period(&s->surface->oscillation);
    print_message("wave with sound, %s %s: %g s\n", cells, c0, period);
    fv_free(&c.s);
    return period;
}

/* fv.c0 under a surface: with phi_tt = c^2 Lap phi in the water w^2 = g q tanh(q H), where q^2 =
 * k^2
 * - w^2/c^2, so that the wave is the slower the smaller c is (Longuet-Higgins 1950, less what
 * gravity does to the density). */
TEST(sound_slows_waves_down)
{
    static const char *const of[2][2] = {{"fv.cells=(16,20)", "fv.graded=(0,0)"},
                                         {"fv.cells=(16,24)", "fv.graded=(1.1,8)"}};
    const double k = 1.57079632679489662, c = 3.0;
    double w2 = k * tanh(k);
    for (int m = 0; m < 60; m++) {
        const double q = sqrt(k * k - w2 / (c * c));
        w2 = q * tanh(q);
    }
    const double slower = sqrt(k * tanh(k) / w2) - 1.0;
    for (int m = 0; m < 2 - SANITIZED; m++) {
        const double without = period_with_sound(of[m][0], of[m][1], "fv.c0=0");
        const double with = period_with_sound(of[m][0], of[m][1], "fv.c0=3");
        if (!SANITIZED)
            assert_close(with / without - 1.0, slower, 0.002);
    }
}

/* A column that falls, turns at the wall and comes back; steps that turn out too long are taken
 * back. Volume is kept, and energy lost. */
TEST(columns_fall)
{
    static const struct scene_shape column = {.form = SHAPE_BOX,
                                              .box = {{0, 0, 0}, {0.31, 0.61, 0.57}}};
    for (int k = SANITIZED; k < (SANITIZED ? 2 : 3); k++) {
        struct fv_case c;
        struct fv *s =
            start(&c, MPI_COMM_WORLD,
                  (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81,0)", k < 2 ? NEWTON : BDF2,
                                        k == 1 ? "fv.cfl=3" : "fv.cfl=0.5",
                                        k == 2 ? "fluid.nu=0.02" : "fluid.nu=1e-6",
                                        "fv.cells=(24,24)", "domain.max=(1,1,1)", NULL},
                  &column, WALL_SLIP);
        const double whole = 9.81 * s->surface->volume0 * 0.61 / 2.0;
        assert_true(fv_case_run(&c, 2000, SANITIZED || k == 2 ? 0.3 : 0.8));
        const double v = surface_volume(s) / s->surface->volume0 - 1.0, K = surface_energy(s);
        print_message("column: %d steps, %d taken back, volume %.3g, energy %.3g of %.3g\n",
                      (int)c.run.step, (int)s->surface->repeats, v, K, whole);
        assert_close(v, 0.0, 1e-4);
        assert_true(K < whole);
        fv_free(&c.s);
    }
}

/* A column of honey, 12 cells of 1 mm a side, nu/(h sqrt(g h)) = 101: creeps down as slowly by rk3
 * as by newton in steps fifty times as long, each its own discretisation in time. */
TEST(honey_creeps)
{
    static const struct scene_shape column = {.form = SHAPE_BOX,
                                              .box = {{-1.0, -1.0, 0.0}, {0.012, 0.012, 0.0}}};
    double speed[2], energy[2];
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        struct fv *s =
            start(&c, MPI_COMM_WORLD,
                  (const char *const[]){SURFACE, "fluid.nu=1e-2", "fluid.gravity=(0,-9.81)",
                                        "fv.cells=(24,16)", "domain.max=(0.024,0.016)",
                                        k ? NEWTON : "fv.integrator=\"rk3\"", NULL},
                  &column, WALL_NO_SLIP);
        assert_true(fv_case_run(&c, 2000, SANITIZED ? 0.008 : 0.08));
        speed[k] = fmax(s->max.u[0], s->max.u[1]);
        energy[k] = surface_energy(s);
        print_message("honey: %d steps, %.4g m/s, energy %.4g\n", (int)c.run.step, speed[k],
                      energy[k]);
        fv_free(&c.s);
    }
    assert_true(SANITIZED || fabs(speed[1] / speed[0] - 1.0) <= 0.05);
    assert_true(SANITIZED || fabs(energy[1] / energy[0] - 1.0) <= 0.1);
}

/* As uniform as it came, at six times the step of rk3. */
TEST(currents_pass_openings)
{
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_WORLD,
                    (const char *const[]){
                        "fv.surface=\"yes\"", CLOSED, "fluid.gravity=(0,-9.81)", "fv.cells=(20,12)",
                        "domain.max=(2,1)", "fluid.nu=1e-2", "initial.level=0.5", integrators[k],
                        "initial.field=\"uniform\"", "initial.velocity=(0.5,0)", NULL});
        wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 0.5);
        wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
        wall_add(&c, SIDE_Y_MIN, WALL_SLIP, 0.0);
        wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
        c.run.scene.shapes[c.run.scene.nshapes++] =
            (struct scene_shape){.form = SHAPE_BELOW, .level = 0.5};
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 10000, 1.0));
        print_message("current: %.3g m/s off, passed %.4g\n",
                      fabs(s->max.u[0] - 0.5) + fabs(s->max.u[1]), s->surface->passed);
        assert_true(fabs(s->max.u[0] - 0.5) + fabs(s->max.u[1]) < 1e-6);
        assert_close(s->surface->passed, 0.5, 1e-6);
        fv_free(&c.s);
    }
}

/* A box of water at rest under gravity that leans: the force of the start is its weight, as its
 * centre rises with no acceleration, and across that what the first step has. */
TEST(leaning_water_starts_with_its_pressure)
{
    static const char *const kinds[3] = {"fv.integrator=\"rk3\"", BDF2, NEWTON};
    const struct scene_shape below = {.form = SHAPE_BOX, .box = {{-1, -1, 0}, {2, 0.4, 0}}};
    for (int k = 0; k < 3; k++) {
        double force[2][4];
        struct fv_case c;
        struct fv *s = start(&c, MPI_COMM_WORLD,
                             (const char *const[]){SURFACE, kinds[k], "fluid.gravity=(0.5,-9.81)",
                                                   "fluid.nu=1e-5", "domain.max=(1,0.8)",
                                                   "fv.cells=(40,32)", NULL},
                             &below, WALL_SLIP);
        for (int n = 0; n < 2; n++) {
            flow_forces(s, NULL, force[n]);
            if (n == 0)
                assert_true(fv_case_run(&c, 1, 0.01));
        }
        print_message("%s: weight off by %.1e, then %.1e, across by %.1e\n", kinds[k],
                      force[0][1] + 9.81 * 0.4, force[1][1] + 9.81 * 0.4,
                      force[1][0] - force[0][0]);
        assert_close(force[0][1], -9.81 * 0.4, 1e-5);
        assert_close(force[0][0], force[1][0], 1e-3);
        fv_free(&c.s);
    }
}
