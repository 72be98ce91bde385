/* test_surface_block_steps.c - a free surface on blocks with bdf2 and newton, and with openings:
 * still water stays still, waves swing as on one block at steps that rk3 cannot take, currents pass
 * as on the uniform grid; ranks change nothing but what the solvers leave, a restart nothing at
 * all. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "surface_blocks.h"

#define ENDS "j_min = \"wall\"; j_max = \"slip\"; "
#define AROUND "i_min = \"periodic\"; i_max = \"periodic\"; "
#define REST "initial.field=\"rest\""
#define RK3 "fv.integrator=\"rk3\""
#define BDF2 "fv.integrator=\"bdf2\""
#define NEWTON "fv.integrator=\"newton\""
#define WAVE                                                                                       \
    "initial.field=\"standing_wave\"", "initial.U=0.01", "initial.L=4", "initial.amplitude=0.01",  \
        "initial.level=1", "fluid.gravity=(0,-1)", "domain.max=(4,1.25)",                          \
        "domain.periodic=(true,false)", "time.end=20"

static const char *const steps[3] = {BDF2, NEWTON, RK3};

static const char basin[] = "{ name = \"basin\"; mapping = \"annulus\"; radius = (0.3, 0.8); arc = "
                            "(180.0, 360.0); cells = (10, 40); " SLIP_I SLIP_J "}";

static void is_still(const char *blocks, double level)
{
    const struct scene_shape water = {.form = SHAPE_BELOW, .level = level};
    for (int k = 0; k < 2; k++) {
        struct mesh_case c;
        struct fv *s = start_blocks(
            &c, MPI_COMM_WORLD, blocks,
            (const char *const[]){HEAVY, REST, "fluid.nu=1e-3", steps[k], NULL}, &water);
        const double volume = surface_volume(s);
        assert_true(s->surface->cuts > 0 && volume > 0.0);
        assert_true(mesh_case_run(s, 8, 100.0));
        assert_close(s->max.u[0], 0.0, 1e-10);
        assert_close(surface_volume(s) / volume, 1.0, 1e-12);
        mesh_case_end(&c, &s);
    }
}

TEST(still_water_stays)
{
    is_still(joined, 0.413);
    is_still(canal, 0.613);
    is_still(turned, 0.363);
    is_still(basin, -0.05);
}

/* Errors of a viscous wave's period and damping over most of two periods. */
static void swings(const char *blocks, const char *step, const char *cfl, const char *nu,
                   double *period, double *damping)
{
    struct mesh_case c;
    struct fv *s = start_blocks(&c, MPI_COMM_WORLD, blocks,
                                (const char *const[]){WAVE, step, cfl, nu, NULL}, NULL);
    c.run.summary = summary_create();
    const double volume = surface_volume(s), h = s->surface->least;
    assert_true(mesh_case_run(s, 1000, SANITIZED ? 1.0 : 10.0));
    surface_summarise(s);
    *period = *damping = 0.0;
    assert_true(SANITIZED || (summary_find(c.run.summary, "error.period", period) &&
                              summary_find(c.run.summary, "error.damping", damping)));
    print_message("wave: %s, c dt/h %.2g, nu dt/h^2 %.2g, %d steps: period %.3g, damping %.3g\n",
                  step, 0.765 * s->step.dt / h, s->nu * s->step.dt / (h * h), (int)c.run.step,
                  *period, *damping);
    assert_close(surface_volume(s) / volume, 1.0, 1e-8);
    DROP(c.run.summary);
    mesh_case_end(&c, &s);
}

/* Five cells of the wave's way a step. */
TEST_ALONE(waves_swing_as_on_one_block)
{
    static const char *const blocks[2] = {
        "{ name = \"one\"; cells = (32, 40); max = (4.0, 1.25); " AROUND ENDS "}",
        "{ name = \"back\"; cells = (32, 40); max = (4.0, 1.25); " AROUND ENDS
        "}, { name = \"over\"; cells = (18, 40); min = (0.9375, 0.0); max = (3.1875, 1.25); " ENDS
        "}"};
    double period[2], damping[2];
    for (int k = SANITIZED ? 1 : 0; k < 2 && is_alone(); k++) {
        swings(blocks[k], NEWTON, "fv.cfl=1.16", "fluid.nu=2e-3", period + k, damping + k);
        assert_close(period[k], 0.0, 0.002);
        assert_close(damping[k], 0.0, 0.03);
        assert_true(SANITIZED ||
                    (period[k] <= 1.2 * period[0] && damping[k] <= fmax(0.006, 1.2 * damping[0])));
    }
    if (!is_alone())
        return;
    for (int k = SANITIZED ? 1 : 0; k < 2; k++) { /* rk3: test_surface_blocks */
        swings(blocks[k], BDF2, "fv.cfl=0.5", "fluid.nu=2e-3", period + k, damping + k);
        assert_close(period[k], 0.0, 0.002);
        assert_close(damping[k], 0.0, 0.03);
    }
    /* where one block is off by less than a third of what is wanted signs decide */
    assert_true(SANITIZED || (period[1] <= fmax(1.2 * period[0], 0.002 / 3.0) &&
                              damping[1] <= fmax(1.2 * damping[0], 0.0075)));
}

/* s: that of a wave by newton with this speed of sound. */
static double period_with_sound(const char *blocks, const char *c0)
{
    struct mesh_case c;
    struct fv *s = start_blocks(&c, MPI_COMM_WORLD, blocks,
                                (const char *const[]){WAVE, NEWTON, "fv.cfl=0.6", c0, NULL}, NULL);
    assert_true(mesh_case_run(s, 1000, 10.0));
    const double period = fit_period(&s->surface->oscillation);
    print_message("wave with sound, %s: %g s\n", c0, period);
    mesh_case_end(&c, &s);
    return period;
}

/* fv.c0 = 3 m/s, as on the uniform grid (test_surface_implicit has the theory). */
TEST_ALONE(sound_slows_waves_down)
{
    static const char *const blocks[2] = {
        "{ name = \"one\"; cells = (16, 20); max = (4.0, 1.25); " AROUND SLIP_J "}",
        "{ name = \"back\"; cells = (16, 20); max = (4.0, 1.25); " AROUND SLIP_J
        "}, { name = \"over\"; cells = (9, 20); min = (0.9375, 0.0); max = (3.1875, 1.25); " SLIP_J
        "}"};
    const double k = 1.57079632679489662, c = 3.0;
    double w2 = k * tanh(k);
    for (int m = 0; m < 60; m++) {
        const double q = sqrt(k * k - w2 / (c * c));
        w2 = q * tanh(q);
    }
    for (int m = getenv("LONG") ? 0 : 1; m < 2 && !SANITIZED && is_alone(); m++) {
        const double without = period_with_sound(blocks[m], "fv.c0=0"),
                     with = period_with_sound(blocks[m], "fv.c0=3");
        assert_close(with / without - 1.0, sqrt(k * tanh(k) / w2) - 1.0, 0.002);
    }
}

/* nu dt/h^2 = 20, eleven steps a period; cells of aspect 50, eight a length. */
TEST_ALONE(viscosity_and_flat_cells_bound_no_step)
{
    double T, r;
    if (SANITIZED || !is_alone())
        return;
    swings("{ name = \"l\"; cells = (8, 40); max = (2.0, 1.25); i_min = \"periodic\"; i_max = "
           "\"joined\"; " ENDS "}, { name = \"r\"; cells = (8, 40); min = (2.0, 0.0); "
           "max = (4.0, 1.25); i_min = \"joined\"; i_max = \"periodic\"; " ENDS "}",
           NEWTON, "fv.cfl=1.5", "fluid.nu=0.05", &T, &r);
    assert_close(T, 0.0, 0.03);
    assert_close(r, 0.0, 0.1);
    swings("{ name = \"low\"; cells = (8, 64); max = (4.0, 0.625); j_min = \"wall\"; j_max = "
           "\"joined\"; " AROUND "}, { name = \"high\"; cells = (8, 64); min = (0.0, 0.625); "
           "max = (4.0, 1.25); j_min = \"joined\"; j_max = \"slip\"; " AROUND "}",
           NEWTON, "fv.cfl=0.7", "fluid.nu=2e-3", &T, &r);
    assert_close(T, 0.0, 0.03);
    assert_close(r, 0.0, 0.1);
}

/* --- openings --- */

/* From an inlet to an outlet, whose water stands at the level; "" are no blocks: the uniform grid.
 */
static struct fv *start_current(struct mesh_case *c, const char *blocks, const char *step,
                                bool rest, bool carried)
{
    const double U = rest ? 0.1 : 0.5;
    const struct scene_wall walls[] = {
        {.side = SIDE_X_MIN, .kind = WALL_INFLOW, .velocity = {U, 0.0, 0.0}},
        {.side = SIDE_X_MAX, .kind = WALL_OUTFLOW, .carried = carried},
        {.side = SIDE_Y_MIN, .kind = WALL_SLIP},
        {.side = SIDE_Y_MAX, .kind = WALL_SLIP}};
    mesh_case_read(c, MPI_COMM_WORLD, blocks,
                   (const char *const[]){HEAVY,
                                         carried ? "fv.surface=\"yes\"" : "initial.level=0.5",
                                         "domain.min=(0,0)", "domain.max=(2,1)", "fluid.nu=1e-2",
                                         step, rest ? REST : "initial.field=\"uniform\"",
                                         rest ? "initial.U=0.1" : "initial.velocity=(0.5,0)",
                                         *blocks ? NULL : "fv.cells=(40,24)", NULL});
    memcpy(c->run.scene.walls, walls, sizeof walls);
    c->run.scene.nwalls = 4;
    c->run.scene.shapes[c->run.scene.nshapes++] =
        (struct scene_shape){.form = SHAPE_BELOW, .level = 0.5};
    return mesh_case_create(c, NULL);
}

/* m/s: largest distance of the water's velocity from (U, 0). */
static double farthest(const struct fv *s, double U)
{
    double most = 0.0;
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            if (s->surface->layer[i] == 0 && !(s->m && s->free[i] == 0.0))
                most = fmax(most, hypot(s->u[0][i] - U, s->u[1][i]));
    return ranks_max(s->comm, most);
}

static const char over[] = "{ name = \"back\"; cells = (40, 24); max = (2.0, 1.0); }, { name = "
                           "\"over\"; cells = (17, 24); min = (0.525, 0.0); max = (1.375, 1.0); }";

/* As uniform as it came. */
TEST(currents_pass_openings)
{
    static const char *const blocks[3] = {halves, stretched, over};
    for (int k = 0; k < 9; k += SANITIZED ? 4 : 1) {
        struct mesh_case c;
        struct fv *s = start_current(&c, blocks[k / 3], steps[k % 3], false, false);
        assert_true(mesh_case_run(s, 1000, 0.5));
        assert_close(farthest(s, 0.5), 0.0, 1e-9);
        assert_close(s->surface->passed, 0.25, 1e-9);
        assert_close(surface_volume(s), 1.0, 1e-6);
        mesh_case_end(&c, &s);
    }
}

/* From rest waves run between the openings: what is there is what was, and came in, and went out,
 * as much as on the uniform grid; joined blocks of the same cells are no other grid. */
TEST_ALONE(waves_between_openings_are_those_of_the_uniform_grid)
{
    static const char *const blocks[4] = {"", halves, stretched, over};
    static const double close[4] = {0.0, 5e-4, 5e-3, 5e-3};
    for (int q = 1; q < 2 && is_alone(); q++) {
        double volume[4], passed[4];
        for (int k = SANITIZED ? 3 : 0; k < 4; k++) {
            struct mesh_case c;
            struct fv *s = start_current(&c, blocks[k], steps[q], true, false);
            assert_true(mesh_case_run(s, 1000, SANITIZED ? 0.3 : 1.5));
            volume[k] = surface_volume(s);
            passed[k] = s->surface->passed;
            print_message("from rest, %s: %d steps, volume %.6g, passed %.6g, put back %.3g\n",
                          steps[q], (int)c.run.step, volume[k], passed[k], s->surface->returned);
            assert_close(volume[k], s->surface->volume0, 1e-6);
            /* the inlet opens at once: half a step of it is put back; on blocks that overlap, which
             * lose as much again, below what the watch calls sound, 1 % of the water */
            assert_close(s->surface->returned, 0.0, 0.01 * (k < 3 ? passed[k] : volume[k]));
            if (!SANITIZED) {
                assert_close(volume[k], volume[0], close[k]);
                assert_close(passed[k], passed[0], close[k]);
            }
            mesh_case_end(&c, &s);
        }
    }
}

/* Out of an outflow that carries it a uniform current leaves as it is. From rest the inlet makes a
 * wave, which runs out: it leaves the inlet's velocity everywhere and water that is higher by
 * U H/c, c = sqrt(g H). */
TEST_ALONE(currents_are_carried_out)
{
    static const char *const blocks[4] = {"", halves, stretched, over};
    for (int k = 0; k < 12; k++) {
        struct mesh_case c;
        const bool rest = k % 3 == 2;
        if (rest && (SANITIZED || !is_alone() || k / 3 == 1)) /* halves are the uniform grid */
            continue;
        struct fv *s = start_current(&c, blocks[k / 3], steps[k % 3], rest, true);
        assert_true(mesh_case_run(s, 1000, rest ? 5.0 : 0.3));
        const double off = farthest(s, rest ? 0.1 : 0.5), volume = surface_volume(s);
        print_message("carried out: %.3g m/s off, volume %.5g\n", off, volume);
        assert_close(off, 0.0, rest ? 5e-3 : 1e-9);
        assert_close(volume, rest ? 1.0 + 0.1 * 0.5 / sqrt(9.81 * 0.5) * 2.0 : 1.0,
                     rest ? 0.01 : 1e-6);
        assert_close(volume, s->surface->volume0, 1e-6);
        mesh_case_end(&c, &s);
    }
}

/* --- ranks and restarts --- */

TEST(ranks_agree)
{
    if (is_alone())
        skip();
    for (int k = 0; k < 2; k++) {
        const char *const of[] = {
            HEAVY,    REST, "fluid.nu=1e-3", k ? "fv.tol_newton=1e-9" : "fv.tol_pressure=1e-9",
            steps[k], NULL};
        struct mesh_case one, all;
        struct fv *s = start_blocks(&one, MPI_COMM_SELF, turned, of, &column),
                  *z = start_blocks(&all, MPI_COMM_WORLD, turned, of, &column);
        assert_true(mesh_case_run(s, 4, 100.0) && mesh_case_run(z, 4, 100.0));
        assert_close(surface_energy(z) / surface_energy(s), 1.0, 1e-7);
        assert_close(surface_volume(z) / surface_volume(s), 1.0, 1e-10);
        mesh_case_end(&one, &s);
        mesh_case_end(&all, &z);
    }
}

TEST(restart_is_exact)
{
    for (int k = 0; k < 2; k++) {
        const char *const of[] = {HEAVY, REST, "fluid.nu=1e-3", steps[k], NULL};
        struct mesh_case one, again;
        struct fv *s = start_blocks(&one, MPI_COMM_WORLD, turned, of, &column);
        mesh_case_read(&again, MPI_COMM_WORLD, turned, of);
        again.run.scene.shapes[again.run.scene.nshapes++] = column;
        assert_int_equal(mesh_case_restart(&one, s, &again, 3), 0);
    }
}
