/* test_fv_limits.c - the default step is stable in every direction and at any Reynolds number, on
 * rows, on blocks, from rest, at an outflow, below a surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "fv_bc_case.h"
#include "mesh_case.h"

#include "../../../fv/watch/limits.h"
#include "../../../fv/watch/watches.h"

#define CARRIED "initial.field=\"two_modes\"", "fv.cells=(32,32)"
#define SMALL 0.28 /* a quarter of the default: what is left is the error of space */

/* Error of velocity at t with this step; 0: the integrator's own. */
static double error_at(const char *const *overrides, double cfl, double t)
{
    struct fv_case c;
    double row[FV_CASE_ROW];
    fv_case_set(&c, MPI_COMM_SELF, overrides);
    struct fv *s = fv_case_start(&c, NULL);
    s->prm.cfl = cfl > 0.0 ? cfl : s->prm.cfl;
    const bool good = fv_case_run(&c, 100000, t);
    VALUES_OF(fv_row, s, row);
    fv_free(&c.s);
    return good ? row[3] : NAN;
}

/* What time costs is not more than what space does. */
static void holds(const char *const *overrides, double t)
{
    if (SANITIZED)
        t *= 0.25;
    const double own = error_at(overrides, 0.0, t), small = error_at(overrides, SMALL, t);
    print_message("%s %s: %.3g, at a quarter of the step %.3g\n", overrides[2], overrides[3], own,
                  small);
    assert_true(own < 2.0 * small);
}

TEST(rk3_holds_in_every_direction)
{
    holds((const char *const[]){CARRIED, "initial.velocity=(3,3)", "fluid.nu=1e-4", NULL}, 0.4);
    holds((const char *const[]){CARRIED, "initial.velocity=(-3,1.5)", "fluid.nu=0", NULL}, 0.4);
    holds((const char *const[]){CARRIED, "initial.velocity=(0,3)", "fluid.nu=1e-6", NULL}, 0.4);
    holds((const char *const[]){CARRIED, "initial.velocity=(1,-2)", "fluid.nu=1e-2", NULL}, 0.4);
    holds((const char *const[]){"initial.field=\"beltrami\"", "fv.cells=(16,16,16)",
                                "initial.velocity=(0.5,0.25,0.125)", "fluid.nu=1e-3",
                                "domain.dim=3", NULL},
          0.6);
    holds((const char *const[]){CARRIED, "initial.velocity=(3,2)", "fluid.nu=1e-5",
                                "domain.periodic=(true,false)", "fv.graded=(0.6,16)", NULL},
          0.3);
}

/* Vortices that break up on eight cells a side, after 17 turns, lose energy and gain none. */
TEST(rk3_holds_where_nothing_is_resolved)
{
    static const char *const nu[] = {"fluid.nu=0", "fluid.nu=3e-5"};
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){"initial.field=\"beltrami\"", "fv.cells=(8,8,8)",
                                          "domain.dim=3", nu[k], NULL});
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 100000, SANITIZED ? 1.0 : 20.0));
        assert_true(s->watches->energy.worst < s->watches->energy.warn);
        fv_free(&c.s);
    }
}

/* Its own step follows the cell Reynolds number: here 0.5, 50 and 5000. Of second order in time. */
TEST(bdf2_holds_at_any_viscosity)
{
    static const char *const nu[] = {"fluid.nu=0.1", "fluid.nu=1e-3", "fluid.nu=1e-5"};
    for (int k = 0; k < 3; k++) {
        const double e = error_at((const char *const[]){CARRIED, "initial.velocity=(0.5,0.25)",
                                                        nu[k], "fv.integrator=\"bdf2\"", NULL},
                                  0.0, k ? 0.5 : 0.02);
        print_message("bdf2, %s: %.3g\n", nu[k], e);
        assert_true(e < 0.01);
    }
}

TEST(newton_holds_without_viscosity)
{
    const char *const all[] = {CARRIED, "initial.velocity=(3,3)", "fluid.nu=0",
                               "fv.integrator=\"newton\"", NULL};
    assert_true(error_at(all, 0.0, 0.1) < 0.05); /* of second order in time */
}

TEST(blocks_hold)
{
    static const char waving[] =
        "{ name = \"a\"; mapping = \"sheared\"; wave = 0.06; " PERIODIC "cells = (32, 32); }";
    static const char *const step[] = {"fv.cfl=0", "fv.cfl=0.28"};
    double e[2][3];
    for (int k = 0; k < 2; k++)
        mesh_case_errors(
            waving, (const char *const[]){"initial.velocity=(3,3)", "fluid.nu=1e-5", step[k], NULL},
            SANITIZED ? 0.05 : 0.2, e[k]);
    print_message("waving cells: %.3g, at a quarter of the step %.3g\n", e[0][0], e[1][0]);
    assert_true(e[0][0] < 2.0 * e[1][0]);
}

/* Gravity in a periodic box, a lid, pressures: the first steps are no longer than the others. */
TEST(starts_from_rest_hold)
{
    for (int k = 0; k < 3; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){"initial.field=\"rest\"", "fv.cells=(24,24)",
                                          k == 0 ? "fluid.gravity=(30,20)" : CLOSED,
                                          "fluid.nu=1e-3", NULL});
        for (int side = SIDE_X_MIN; k > 0 && side <= SIDE_Y_MAX; side++)
            wall_add(&c, (enum scene_side)side,
                     k == 2 && side <= SIDE_X_MAX ? WALL_OUTFLOW : WALL_NO_SLIP,
                     k == 1 && side == SIDE_Y_MAX ? 100.0 : 0.0)
                ->pressure = k == 2 && side == SIDE_X_MIN ? 1e3 : 0.0;
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 30, 100.0));
        print_message("from rest: %.3g cells, growth %.3g\n", s->totals.max_cfl,
                      s->watches->growth.worst);
        assert_true(s->totals.max_cfl > 0.2 && s->totals.max_cfl < 1.262);
        fv_free(&c.s);
    }
}

/* A channel of Re 1000: what leaves is not amplified. */
TEST(convective_outflow_holds)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){CLOSED, "initial.field=\"rest\"", "fluid.nu=1e-3",
                                      "domain.max=(4,1)", "fv.cells=(64,16)", NULL});
    wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0)->profile = PROFILE_PARABOLIC;
    wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0)->carried = true;
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 10000, 8.0));
    print_message("outflow: %.3g, %.3g m/s, limited by %s\n", s->max.u[0], s->max.u[1],
                  limit_name(s->step.limit));
    assert_true(s->max.u[0] < 1.05 && s->max.u[1] < 0.05);
    assert_int_equal(s->step.limit, LIMIT_OUTFLOW);
    fv_free(&c.s);
}

/* A uniform stream: what is not uniform leaves it, and nothing is left that products could hold. */
TEST(streams_without_residual_hold)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){"initial.field=\"uniform\"", "initial.velocity=(-0.649,0)",
                                      "initial.U=0.649", "fluid.nu=0", "domain.max=(1.1875,0.5625)",
                                      "domain.periodic=(false,true)", "fv.cells=(38,18)", NULL});
    wall_add(&c, SIDE_X_MAX, WALL_INFLOW, 0.0)->velocity[0] = -0.649;
    wall_add(&c, SIDE_X_MIN, WALL_OUTFLOW, 0.0)->carried = true;
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 1000, 4.0));
    assert_close(s->max.u[0], 0.649, 1e-12);
    fv_free(&c.s);
}

static struct fv *wave_or_column(struct fv_case *c, bool column)
{
    fv_case_set(c, MPI_COMM_SELF,
                column ? (const char *const[]){"fv.surface=\"yes\"", "initial.field=\"rest\"",
                                               CLOSED, "fluid.gravity=(0,-9.81)", "fluid.nu=1",
                                               "fv.cells=(16,16)", NULL}
                       : (const char *const[]){
                             "fv.surface=\"yes\"", "initial.field=\"standing_wave\"",
                             "initial.level=1", "initial.amplitude=0.01", "initial.L=4",
                             "fluid.nu=0.2", "fluid.gravity=(0,-1)", "domain.max=(4,1.25)",
                             "domain.periodic=(true,false)", "fv.cells=(32,20)", NULL});
    for (int side = column ? SIDE_X_MIN : SIDE_Y_MIN; side <= SIDE_Y_MAX; side++)
        wall_add(c, (enum scene_side)side, WALL_NO_SLIP, 0.0);
    if (column)
        c->run.scene.shapes[c->run.scene.nshapes++] =
            (struct scene_shape){.form = SHAPE_BOX, .box = {{0, 0, 0}, {0.43, 0.61, 0.0}}};
    return fv_case_start(c, NULL);
}

/* The wave is never faster than the inviscid one, a omega; the column than what falls through its
 * height. */
TEST(viscous_surfaces_hold)
{
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        struct fv *s = wave_or_column(&c, k == 1);
        assert_true(fv_case_run(&c, 10000, (SANITIZED ? 0.2 : 1.0) * (k ? 0.3 : 4.0)));
        const double most = k ? sqrt(2.0 * 9.81 * 0.61) : 0.01 * sqrt(0.5 * M_PI);
        print_message("viscous: %.3g m/s, energy gain %.2g\n", fmax(s->max.u[0], s->max.u[1]),
                      s->watches->energy.worst);
        assert_true(fmax(s->max.u[0], s->max.u[1]) < most);
        assert_true(s->watches->energy.worst < s->watches->energy.warn);
        fv_free(&c.s);
    }
}

/* The amplitude of errors, initial.U, is no part of a step. */
TEST(unit_of_errors_sets_no_step)
{
    double dt[2];
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){"initial.field=\"rest\"", "fluid.gravity=(1,0)",
                                          k ? "initial.U=1000" : "initial.U=1e-3", NULL});
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 2, 100.0));
        dt[k] = s->step.dt;
        assert_close(s->speed.limit, 10.0, 0.5); /* g t */
        fv_free(&c.s);
    }
    assert_close(dt[0], dt[1], 0.0);
}

/* A lid over a fluid so viscous that it is steady within a step that the flow alone would allow
 * (Re = 0.01): five times L^2/nu after its start the flow is that of the implicit solver, which
 * solves pressure and friction together. Steps of 1.1 cells: a sixth of its energy. */
TEST(viscous_starts_hold)
{
    static const char *const integrators[] = {"fv.integrator=\"newton\"", "fv.integrator=\"rk3\"",
                                              "fv.integrator=\"bdf2\""};
    double row[FV_CASE_ROW], energy[3];
    for (int k = 0; k < 3; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){"initial.field=\"rest\"", "fv.cells=(16,16)", CLOSED,
                                          "fluid.nu=100", "time.end=0.05", integrators[k], NULL});
        for (int side = SIDE_X_MIN; side <= SIDE_Y_MAX; side++)
            wall_add(&c, (enum scene_side)side, WALL_NO_SLIP, side == SIDE_Y_MAX ? 1.0 : 0.0);
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 300, 0.05));
        assert_close(s->t, 0.05, 1e-12);
        VALUES_OF(fv_row, s, row);
        energy[k] = row[0];
        fv_free(&c.s);
    }
    print_message("lid at Re 0.01: %.5g, %.5g, %.5g J\n", energy[0], energy[1], energy[2]);
    for (int k = 1; k < 3; k++)
        assert_close(energy[k], energy[0], 0.01 * energy[0]);
}

/* Pressures on both ends of a channel a thousand times as long as it is high: the step knows how
 * far they are apart, not how near the walls, and the flow is Poiseuille's, u = dp H^2/(8 mu L). */
TEST(thin_channels_take_few_steps)
{
    struct fv_case c;
    double most = 0.0;
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){"initial.field=\"rest\"", CLOSED, "domain.max=(1,0.001)",
                                      "fluid.nu=1e-6", "fv.cells=(16,16)", "time.end=3", NULL});
    wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_X_MIN, WALL_OUTFLOW, 0.0)->pressure = 8.0 * c.run.scene.fluid.rho;
    wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 1000, 3.0));
    assert_close(s->t, 3.0, 1e-12);
    for (int j = 0; j < s->b.n[1]; j++)
        most = fmax(most, s->u[0][block_at(&s->b, 8, j, 0)]);
    print_message("thin channel: %.6g of 1 m/s\n", most);
    assert_close(most, 1.0, 0.01); /* average of a cell beside the axis: 1 - 0.0052 */
    fv_free(&c.s);
}

/* Vortices that friction levels before they have crossed a cell: within 0.1 % after the time in
 * which they fall to a third. Steps of 1.1 cells: 2 % at Re 1, 0.6 % at 10. */
TEST(flows_that_decay_are_followed)
{
    static const char *const nu[] = {"fluid.nu=1", "fluid.nu=0.1"};
    for (int k = 0; k < 4; k++) {
        const double off = error_at(
            (const char *const[]){"initial.field=\"taylor_green\"", "fv.cells=(16,16)", nu[k / 2],
                                  k % 2 ? "fv.integrator=\"bdf2\"" : "fv.integrator=\"rk3\"", NULL},
            0.0, k < 2 ? 0.0127 : 0.127);
        print_message("%s: velocity off by %.3g\n", nu[k / 2], off);
        assert_true(off < 1e-3);
    }
}
