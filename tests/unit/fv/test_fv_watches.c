/* test_fv_watches.c - the watches tell a flow that grows, waves of two cells and water that is lost
 * from a sound flow, with walls, openings and a surface. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "fv_bc_case.h"
#include "mesh_case.h"

#include "../../../fv/surface/fraction.h"
#include "../../../fv/surface/plane.h"
#include "../../../fv/watch/watches.h"

static void say(const char *what, const struct watches *w)
{
    print_message("%s: energy %.2g, waves %.2g, %.2g, growth %.3g, volume %.2g\n", what,
                  w->energy.worst, w->velocity.worst, w->pressure.worst, w->growth.worst,
                  w->returned.worst);
}

static void is_sound(const char *what, const struct watches *w)
{
    say(what, w);
    assert_true(w->energy.worst < w->energy.warn && w->velocity.worst < w->velocity.warn);
    assert_true(w->pressure.worst < w->pressure.warn && w->growth.worst < w->growth.warn);
    assert_true(w->returned.worst < w->returned.warn);
}

/* At a sum of 1.6 and 2, beyond the limit of 1.262. */
TEST(gained_energy_ends_a_run)
{
    static const double cfl[2] = {1.6, 2.0};
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){"initial.field=\"two_modes\"", "fluid.nu=1e-4",
                                          "initial.velocity=(3,3)", "fv.upwind=0", NULL});
        struct fv *s = fv_case_start(&c, NULL);
        s->prm.cfl = cfl[k];
        assert_false(fv_case_run(&c, 1000, 1.0));
        say("beyond the limit", s->watches);
        assert_true(s->watches->energy.worst > s->watches->energy.stop);
        fv_free(&c.s);
    }
}

/* Energy that grows from nothing, by 1.01 a step, ends a run on blocks that overlap. */
TEST(growing_rest_ends_a_run)
{
    static const char over[] = "{ name = \"back\"; cells = (20, 14); max = (1.0, 0.7); i_min = "
                               "\"slip\"; i_max = \"slip\"; "
                               "j_min = \"slip\"; j_max = \"slip\"; }, { name = \"fine\"; cells = "
                               "(16, 16); min = (0.3, 0.1); "
                               "max = (0.7, 0.5); }";
    const struct scene_shape water = {.form = SHAPE_BELOW, .level = 0.363};
    struct mesh_case c;
    struct diagnosis d = {0};
    mesh_case_read(
        &c, MPI_COMM_WORLD, over,
        (const char *const[]){"fluid.gravity=(0,-9.81)", "initial.field=\"rest\"", NULL});
    c.run.scene.shapes[c.run.scene.nshapes++] = water;
    struct fv *s = mesh_case_create(&c, NULL);
    for (int64_t k = 1; k <= 300 && !d.bad; k++) {
        const struct flow_energy e = {.kinetic = 1e-3 * pow(1.01 * 1.01, (double)k - 300.0),
                                      .volume = 0.4};
        watches_energy(s->watches, &e, 0.01 * (double)k, k, &d);
    }
    assert_true(d.bad && d.reason[0] && d.likely[0]);
    mesh_case_end(&c, &s);
}

/* Water that swings over the edge of a shelf, at half the step, whose hundred steps end at rest:
 * the work of gravity is that of what the surface does, not of averages beside the edge. */
TEST(edges_make_no_energy)
{
    static const char shelf[] =
        "{ name = \"deep\"; cells = (32, 16); max = (1.0, 0.5); i_max = \"slip\"; j_max = "
        "\"joined\"; i_min = \"slip\"; j_min = \"slip\"; }, "
        "{ name = \"left\"; cells = (32, 16); min = (0.0, 0.5); max = (1.0, 1.0); i_min = "
        "\"slip\"; "
        "i_max = \"joined\"; j_min = \"joined\"; j_max = \"slip\"; }, "
        "{ name = \"right\"; cells = (32, 16); min = (1.0, 0.5); max = (2.0, 1.0); i_min = "
        "\"joined\"; i_max = \"slip\"; j_min = \"slip\"; j_max = \"slip\"; }";
    struct scene_shape water = {.form = SHAPE_POLYGON, .points.n = 4};
    static const double corner[4][2] = {{-1, -1}, {-1, 0.68}, {3, 0.72}, {3, -1}};
    struct mesh_case c;
    struct diagnosis d = {0};
    memcpy(water.points.x, corner, sizeof corner);
    mesh_case_read(&c, MPI_COMM_WORLD, shelf,
                   (const char *const[]){"fluid.gravity=(0,-9.81)", "initial.field=\"rest\"",
                                         "domain.max=(2,1)", NULL});
    c.run.scene.shapes[c.run.scene.nshapes++] = water;
    struct fv *s = mesh_case_create(&c, NULL);
    while (!d.bad && c.run.step < (SANITIZED ? 30 : 160)) {
        c.run.t += integrate(s, 10.0, &d);
        c.run.step++;
    }
    say("a shelf", s->watches);
    assert_true(!d.bad && s->watches->energy.worst < s->watches->energy.warn);
    mesh_case_end(&c, &s);
}

TEST(blocks_are_watched)
{
    static const char waving[] =
        "{ name = \"a\"; mapping = \"sheared\"; wave = 0.06; " PERIODIC "cells = (24, 24); }";
    for (int k = 0; k < 2; k++) {
        struct mesh_case c;
        struct fv *s = mesh_case_start(
            &c, MPI_COMM_WORLD, waving,
            (const char *const[]){"initial.velocity=(3,3)", "fluid.nu=1e-4", "fv.upwind=0", NULL});
        s->prm.cfl = k ? 2.2 : 1.1;
        assert_int_equal(mesh_case_run(s, 1000, 0.5), k == 0);
        if (k)
            assert_true(s->watches->energy.worst > s->watches->energy.stop);
        else
            is_sound("blocks", s->watches);
        mesh_case_end(&c, &s);
    }
}

/* Inviscid vortices that cross the edge of a turned block neither gain nor lose energy (8 % while
 * cells beside the edge counted twice). */
TEST(overlaps_gain_no_energy)
{
    static const char turned[] =
        "{ name = \"back\"; " PERIODIC
        "cells = (32, 32); }, { name = \"turned\"; cells = (32, 32); "
        "min = (0.25, 0.25); max = (0.75, 0.75); centre = (0.5, 0.5); angle = 45.0; }";
    struct mesh_case c;
    struct fv *s =
        mesh_case_start(&c, MPI_COMM_WORLD, turned,
                        (const char *const[]){"initial.field=\"taylor_green\"",
                                              "initial.velocity=(0.8,0.3)", "fluid.nu=0", NULL});
    assert_true(mesh_case_run(s, 1000, SANITIZED ? 0.1 : 1.0));
    is_sound("overlaps", s->watches);
    mesh_case_end(&c, &s);
}

/* v = 0.1 (-1)^i needs no pressure and nothing carries it away: it stays in an inviscid flow
 * without bias. */
TEST(waves_of_two_cells_are_seen)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_SELF, (const char *const[]){"fluid.nu=0", "fv.upwind=0", NULL});
    struct fv *s = fv_case_start(&c, NULL);
    BLOCK_CELLS (&s->b, i, j, k, at)
        s->u[1][at] += i % 2 ? 0.1 : -0.1;
    fv_start(s);
    assert_true(fv_case_run(&c, 50, 100.0));
    say("two cells", s->watches);
    assert_true(s->watches->velocity.worst > s->watches->velocity.warn);
    fv_free(&c.s);
}

/* A flow that swings is at rest now and then, and has no pressure when it is fastest: what is left
 * then, a hundredth of its size, is no wave of two cells, and three looks in a row may meet it at
 * rest; a third of its size is one. */
TEST(a_swing_that_turns_is_sound)
{
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        struct diagnosis d = {0};
        fv_case_set(&c, MPI_COMM_SELF, (const char *const[]){"initial.U=1", NULL});
        struct fv *s = fv_case_start(&c, NULL);
        const double left = k ? 1e-1 : 1e-4;
        const struct flow_waves fast = {left, 1.0, left, 1e-8}, turns = {left, 1e-8, left, 1.0};
        for (int look = 1; look <= 6; look++)
            watches_waves(s->watches, look % 4 ? &turns : &fast, 1.0, look, 50 * look, &d);
        watches_waves(s->watches, &fast, 1.0, 6.0, 300, &d); /* the end looks once more */
        s->watches->velocity.worst = s->watches->pressure.worst = 0.0;
        for (int look = 7; look <= 11; look++)
            watches_waves(s->watches, look % 4 ? &turns : &fast, 1.0, look, 50 * look, &d);
        assert_true((s->watches->velocity.worst > s->watches->velocity.warn) == (k == 1));
        assert_true((s->watches->pressure.worst > s->watches->pressure.warn) == (k == 1));
        fv_free(&c.s);
    }
}

TEST(sudden_growth_is_seen)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_SELF, NULL);
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 8, 100.0));
    is_sound("before", s->watches);
    for (int a = 0; a < 2; a++)
        BLOCK_ROWS (&s->b, 3, at, n)
            for (int64_t i = at; i < at + n; i++) {
                s->u[a][i] *= 1.5;
                s->U[a][i] *= 1.5;
            }
    assert_true(fv_case_run(&c, 1, 100.0));
    assert_true(s->watches->growth.worst > 1.4);
    fv_free(&c.s);
}

/* A lid, and vortices that leave through an outflow of either kind: work of walls, fluxes of energy
 * and of pressure are in the budget. */
TEST(walls_and_openings_are_in_the_budget)
{
    for (int k = 0; k < 3; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){CLOSED, "fluid.nu=1e-3", "fv.cells=(32,32)",
                                          k ? "initial.velocity=(1,0)" : "initial.field=\"rest\"",
                                          k ? "initial.U=0.3" : "initial.U=1", NULL});
        for (int side = SIDE_Y_MIN; side <= SIDE_Y_MAX; side++)
            wall_add(&c, (enum scene_side)side, k ? WALL_SLIP : WALL_NO_SLIP,
                     k == 0 && side == SIDE_Y_MAX ? 1.0 : 0.0);
        wall_add(&c, SIDE_X_MIN, k ? WALL_INFLOW : WALL_NO_SLIP, k ? 1.0 : 0.0);
        if (k == 0)
            c.run.scene.walls[2].velocity[0] = 0.0;
        wall_add(&c, SIDE_X_MAX, k ? WALL_OUTFLOW : WALL_NO_SLIP, 0.0)->carried = k == 2;
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 300, 4.0));
        is_sound(k == 0 ? "lid" : k == 1 ? "outflow" : "convective outflow", s->watches);
        assert_true(s->watches->has_energy);
        fv_free(&c.s);
    }
}

/* A film of 0.64 cells that a slope makes run off, without shares of water. */
TEST(lost_water_is_not_accepted)
{
    struct fv_case c;
    double volume = 0.0;
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){"fv.surface=\"yes\"", "initial.field=\"rest\"", CLOSED,
                                      "fluid.gravity=(2,-9.81)", "fluid.nu=1e-6",
                                      "fv.volume=\"shift\"", NULL});
    fv_case_close(&c, WALL_SLIP);
    c.run.scene.shapes[c.run.scene.nshapes++] =
        (struct scene_shape){.form = SHAPE_BOX, .box = {{-1, -1, 0}, {2, 0.02, 0}}};
    struct fv *s = fv_case_start(&c, NULL);
    c.run.summary = summary_create();
    assert_true(fv_case_run(&c, 1000, 0.6));
    say("film", s->watches);
    fv_watches_end(s);
    assert_true(summary_find(c.run.summary, "watch.volume_returned", &volume) && volume > 0.05);
    assert_non_null(summary_find_text(c.run.summary, "not_accepted"));
    DROP(c.run.summary);
    fv_free(&c.s);
}

/* Kinetic energy and that of height (m^4/s^2) of the water the fluxes have carried, below the
 * planes in mixed cells: what the watch books as work of gravity, known a second way. */
static double energy_of_water(const struct fv *s)
{
    double sum = 0.0;
    FLOW_ROWS_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const double C = s->surface->fraction->C[i], h = block_size(&s->b, 1, j);
            double x[3], n3[3] = {0.0, 1.0, 0.0}, height = 0.0;
            grid_place(&s->grid, i, x);
            if (fraction_is_mixed(C)) {
                fraction_normal(s, part, i, n3);
                const double alpha = plane_alpha(2, n3, C);
                for (double y = -0.5; y < 0.49; y += 0.125)
                    height += (y + 0.0625) * plane_slab(2, n3, alpha, 1, y, y + 0.125);
            }
            sum += block_volume(&s->b, j) *
                   (C * 0.5 * (s->u[0][i] * s->u[0][i] + s->u[1][i] * s->u[1][i]) +
                    9.81 * (C * x[1] + height * h));
        }
    return sum;
}

/* Water that swings by a sixth of a cell, without viscosity: its energy is that of its start, which
 * is no gain once there is a scale. */
TEST(gentle_waves_gain_no_energy)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){"fv.surface=\"yes\"", "initial.field=\"rest\"", CLOSED,
                                      "domain.max=(1,0.7)", "fv.cells=(32,24)", "fluid.nu=0",
                                      "fluid.gravity=(0.1,-9.81)", NULL});
    fv_case_close(&c, WALL_SLIP);
    c.run.scene.shapes[c.run.scene.nshapes++] =
        (struct scene_shape){.form = SHAPE_BOX, .box = {{-1, -1, 0}, {2, 0.4, 0}}};
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 150, 100.0));
    is_sound("gentle waves", s->watches);
    assert_true(s->watches->looks > WATCH_STEPS);
    fv_free(&c.s);
}

/* A column that falls, runs up the far wall and strikes the lid in its corner with a jet of a cell
 * or two: no energy comes of that, and the watch's budget is that of the water. */
TEST(splashes_gain_no_energy)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){"fv.surface=\"yes\"", "initial.field=\"rest\"", CLOSED,
                                      "domain.max=(1.6,1)", "fv.cells=(64,40)", "fluid.nu=0",
                                      "fluid.gravity=(0,-9.81)", NULL});
    fv_case_close(&c, WALL_SLIP);
    c.run.scene.shapes[c.run.scene.nshapes++] =
        (struct scene_shape){.form = SHAPE_BOX, .box = {{-1, -1, 0}, {0.4, 0.5, 0}}};
    struct fv *s = fv_case_start(&c, NULL);
    const double whole = energy_of_water(s);
    double most = 0.0, off = 0.0, low = INFINITY, high = -INFINITY;
    for (int k = 1; k <= 16; k++) {
        assert_true(fv_case_run(&c, 1000, 0.05 * k));
        const double now = energy_of_water(s);
        most = fmax(most, now / whole - 1.0);
        off = s->watches->balance - now;
        low = fmin(low, off);
        high = fmax(high, off);
    }
    say("splash", s->watches);
    print_message("energy of the water %.3g, the watch off by %.3g\n", most, (high - low) / whole);
    assert_true(s->watches->energy.worst < 0.02);
    assert_true(most < 0.005 && (high - low) / whole < 0.01);
    fv_free(&c.s);
}

/* Water that fills the domain flows on through its outlet, but the loss of its surface is told; a
 * river whose surface stays is none. What cells at the inflow have too much does not feed itself.
 */
TEST(a_full_domain_is_told)
{
    for (int full = 0; full < 2; full++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){"fv.surface=\"yes\"", "initial.field=\"rest\"", CLOSED,
                                          "initial.level=0.5", "fluid.gravity=(0,-9.81)", NULL});
        for (int side = SIDE_X_MIN; side <= SIDE_Y_MAX; side++)
            wall_add(&c, (enum scene_side)side,
                     side == SIDE_X_MIN   ? WALL_INFLOW
                     : side == SIDE_X_MAX ? WALL_OUTFLOW
                                          : WALL_SLIP,
                     side == SIDE_X_MIN ? 0.1 : 0.0);
        c.run.scene.shapes[c.run.scene.nshapes++] =
            (struct scene_shape){.form = SHAPE_BOX, .box = {{-1, -1, 0}, {2, full ? 2 : 0.5, 0}}};
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 2, 1.0));
        assert_int_equal(s->watches->filled, full);
        struct fraction *f = s->surface->fraction;
        f->carries = full;
        for (int j = 0; j < s->b.n[1] && full; j++)
            f->C[block_at(&s->b, 0, j, 0)] = 1.2;
        const double before = fraction_volume(s);
        assert_true(!full || fv_case_run(&c, 20, 100.0));
        assert_true(fraction_volume(s) <= before * (1.0 + 1e-12));
        fv_free(&c.s);
    }
}
