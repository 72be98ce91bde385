/* test_surface_moving.c - a free surface on blocks of which one has a body's walls or moves: still
 * water stays still, forces are those of theory, ranks and restarts agree. ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "mesh_case.h"

#include "../../../fv/boundary/mesh_sides.h"
#include "../../../fv/operators/flow_measures.h"
#include "../../../fv/surface/mesh_view.h"

#define SLIP "i_min = \"slip\"; i_max = \"slip\"; j_min = \"slip\"; j_max = \"slip\"; "
#define HEAVY "fluid.gravity=(0,-9.81)"
#define REST "initial.field=\"rest\"", "fluid.nu=0"
#define THIN "initial.field=\"rest\"", "fluid.nu=1e-7"
#define RK3 "fv.integrator=\"rk3\""
#define BDF2 "fv.integrator=\"bdf2\""
#define NEWTON "fv.integrator=\"newton\""
static const char *const steps[3] = {RK3, BDF2, NEWTON};

static const char half[] =
    "{ name = \"tank\"; cells = (48, 42); min = (-1.6, -1.6); max = (1.6, 1.2); " SLIP
    "}, { name = \"ring\"; mapping = \"annulus\"; radius = (0.5, 1.15); cells = (10, 48); i_min = "
    "\"slip\"; j_min = \"joined\"; j_max = \"joined\"; }";
static const char short_one[] =
    "{ name = \"tank\"; cells = (30, 28, 6); min = (-1.6, -1.6, 0.0); max = (1.6, 1.4, 0.4); " SLIP
    "k_min = \"slip\"; k_max = \"slip\"; }, { name = \"ring\"; mapping = \"annulus\"; radius = "
    "(0.5, 1.39); min = (0.0, 0.0, 0.0); max = (0.0, 0.0, 0.4); cells = (10, 36, 6); i_min = "
    "\"slip\"; j_min = \"joined\"; j_max = \"joined\"; k_min = \"slip\"; k_max = \"slip\"; }";
#define SWINGS                                                                                     \
    "{ name = \"tank\"; cells = (30, 21); max = (1.0, 0.7); " SLIP                                 \
    "}, { name = \"turned\"; cells = (14, 14); min = (0.3, 0.15); max = (0.7, 0.55); angle = "     \
    "30.0; centre = (0.5, 0.35); motion = ( { kind = \"harmonic\"; axis = \"y\"; amplitude = "     \
    "0.05; period = 1.0; }, { kind = \"harmonic\"; axis = \"x\"; amplitude = 0.05; period = 0.7; " \
    "}, { kind = \"harmonic\"; axis = \"rz\"; amplitude = 0.5; period = 1.3; } ); }"

static struct fv *start(struct mesh_case *c, MPI_Comm comm, const char *blocks,
                        const char *const *overrides, double level)
{
    mesh_case_read(c, comm, blocks, overrides);
    c->run.scene.shapes[c->run.scene.nshapes++] =
        (struct scene_shape){.form = SHAPE_BELOW, .level = level};
    return mesh_case_create(c, NULL);
}

/* Force along y on the bodies. */
static double lift(struct fv *s)
{
    double force[FLOW_BODIES_MAX][4], all[4];
    flow_forces(s, force, all);
    return force[1][1];
}

/* Area of the part of a circle of radius a below the height l over its centre. */
static double segment(double a, double l)
{
    const double th = asin(l / a);
    return a * a * (0.5 * M_PI + th + sin(th) * cos(th));
}

TEST(a_body_at_rest_has_its_buoyancy)
{
    static const double levels[2] = {0.0, 0.113};
    for (int k = SANITIZED ? 2 : 0; k < 3; k++) {
        struct mesh_case c;
        const double level = levels[k % 2];
        struct fv *s = start(&c, MPI_COMM_WORLD, k == 2 ? short_one : half,
                             (const char *const[]){k == 2 ? "fluid.gravity=(0,-9.81,0)" : HEAVY,
                                                   REST, k == 2 ? "domain.dim=3" : NULL, NULL},
                             level);
        const double volume = surface_volume(s);
        assert_true(mesh_case_run(s, SANITIZED ? 1 : k == 2 ? 4 : 20, 100.0));
        assert_close(s->max.u[0], 0.0, 1e-10);
        assert_close(surface_volume(s) / volume, 1.0, 1e-12);
        const double buoyancy = 9.81 * segment(0.5, level) * (k == 2 ? 0.4 : 1.0);
        assert_close(lift(s) / buoyancy, 1.0, 0.01);
        if (k < 2) /* a polygon of 48 sides */
            assert_close(volume, 3.2 * (1.6 + level) - segment(0.5, level), 5e-3);
        mesh_case_end(&c, &s);
    }
}

/* m^dim: what all cells hold together. */
static double room(const struct fv *s)
{
    double sum = 0.0;
    for (int64_t i = 0; i < s->size; i++)
        sum += s->surface->mesh->count[i];
    return ranks_sum(MPI_COMM_WORLD, sum);
}

/* Whatever a block without walls does in it, to rounding; and all cells together keep what they
 * hold. */
TEST(still_water_stays_where_a_block_moves)
{
    for (int q = 0; q < 3; q++) {
        struct mesh_case c;
        struct fv *s = start(&c, MPI_COMM_WORLD, SWINGS,
                             (const char *const[]){HEAVY, THIN, steps[q], NULL}, 0.363);
        double worst = 0.0;
        for (int k = 0; k < (SANITIZED ? 1 : q == 0 ? 8 : 4); k++) {
            assert_true(mesh_case_run(s, 3, 100.0));
            worst = fmax(worst, s->max.u[0]);
            assert_close(room(s), 0.7, 1e-12);
        }
        print_message("%s: %.3g m/s, put back %.2g\n", steps[q], worst, s->surface->returned);
        assert_close(worst, 0.0, 1e-10);
        assert_close(surface_volume(s), 0.363, 1e-12);
        assert_close(s->surface->returned, 0.0, 1e-12);
        mesh_case_end(&c, &s);
    }
}

/* Without gravity the potential is odd about the surface: half the force on a cylinder in a closed
 * square of side 8 a, whose added mass is 1.1135 rho pi a^2. */
TEST(a_body_that_speeds_up_has_its_added_mass)
{
    static const char blocks[] =
        "{ name = \"tank\"; cells = (52, 44); min = (-2.0, -2.0); max = (2.0, 1.4); " SLIP
        "}, { name = \"ring\"; mapping = \"annulus\"; radius = (0.5, 1.3); cells = (14, 64); "
        "i_min = \"slip\"; j_min = \"joined\"; j_max = \"joined\"; motion = ( { kind = "
        "\"polynomial\"; axis = \"y\"; coefficients = (0.0, 0.0, 0.05); } ); }";
    for (int q = 0; q < (SANITIZED ? 1 : 3); q++) {
        struct mesh_case c;
        struct fv *s = start(
            &c, MPI_COMM_WORLD, blocks,
            (const char *const[]){"fluid.gravity=(0,-1e-6)", THIN, steps[q], "time.end=0.3", NULL},
            0.0);
        const double all = room(s), volume = surface_volume(s);
        bool good = true;
        for (int k = 1; k <= (SANITIZED ? 2 : 8); k++)
            good = mesh_case_run(s, 100, 0.025 * k) && good;
        const double mass = -lift(s) / 0.1 / (0.5 * M_PI * 0.25);
        print_message("%s: added mass %.4f, wanted 1.1135; put back %.2g\n", steps[q], mass,
                      s->surface->returned);
        assert_true(good);
        assert_close(mass / 1.1135, 1.0, 0.04);
        assert_close(room(s), all, 1e-12);
        assert_close(surface_volume(s), volume, 1e-9);
        assert_close(s->surface->returned, 0.0, 3e-4); /* 2e-3 moved */
        mesh_case_end(&c, &s);
    }
}

static const char *const exactly[] = {HEAVY, REST, "fv.tol_pressure=1e-9", NULL};

static void start_column(struct mesh_case *c, MPI_Comm comm)
{
    static const struct scene_shape column = {.form = SHAPE_BOX,
                                              .box = {{-1.0, -1.0}, {0.35, 0.45}}};
    mesh_case_read(c, comm, SWINGS, exactly);
    c->run.scene.shapes[c->run.scene.nshapes++] = column;
    fv_params_check(&c->run, &c->faults);
    if (params_report(&c->faults) > 0)
        abort();
}

/* Water drawn flush with the walls of a cup that then tilts by 20 degrees: its sides are walls and
 * no surface, so the cup carries its weight. */
TEST(a_cup_that_tilts_carries_its_water)
{
    static const char cup[] =
        "{ name = \"cup\"; min = (-0.5, -0.3); max = (0.5, 0.4); cells = (30, 21); " SLIP
        "motion = ( { kind = \"polynomial\"; axis = \"rz\"; coefficients = (0, 0.17453); until = "
        "2.0; } ); }";
    struct mesh_case c;
    mesh_case_read(&c, MPI_COMM_WORLD, cup,
                   (const char *const[]){HEAVY, "initial.field=\"rest\"", "fluid.nu=1e-2",
                                         "time.end=4", NULL});
    c.run.scene.shapes[c.run.scene.nshapes++] =
        (struct scene_shape){.form = SHAPE_BOX, .box = {{-0.5, -0.3}, {0.5, 0.0}}};
    fv_params_check(&c.run, &c.faults);
    assert_int_equal(params_report(&c.faults), 0);
    struct fv *s = fv_create(&c.run, NULL);
    const double period = 2.0 * M_PI / sqrt(9.81 * M_PI * tanh(0.3 * M_PI)); /* it still sways */
    const double weight = s->run->scene.fluid.rho * 9.81 * 0.3;
    double force[FLOW_BODIES_MAX][4], all[4], mean[2] = {0.0, 0.0};
    if (SANITIZED) {
        assert_true(mesh_case_run(s, 10, 4.0));
        mesh_case_end(&c, &s);
        return;
    }
    assert_true(mesh_case_run(s, 10000, 4.0 - period));
    for (int k = 1; k <= 16; k++) {
        assert_true(mesh_case_run(s, 10000, 4.0 - period + period * k / 16.0));
        flow_forces(s, force, all);
        for (int a = 0; a < 2; a++)
            mean[a] += force[0][a] / 16.0;
    }
    print_message("cup: force %.4g, %.5g of %.5g N, %.2g of the water restored\n", mean[0], mean[1],
                  -weight, s->surface->returned / 0.3);
    assert_close(mean[1], -weight, 0.005 * weight);
    assert_close(mean[0], 0.0, 0.005 * weight);
    assert_close(s->surface->returned, 0.0, 0.005 * 0.3);
    mesh_case_end(&c, &s);
}

TEST(ranks_agree)
{
    struct mesh_case one, all;
    start_column(&one, MPI_COMM_SELF);
    start_column(&all, MPI_COMM_WORLD);
    struct fv *s = fv_create(&one.run, NULL), *z = fv_create(&all.run, NULL);
    assert_true(mesh_case_run(s, 6, 100.0) && mesh_case_run(z, 6, 100.0));
    assert_close(surface_energy(z) / surface_energy(s), 1.0, 1e-7);
    assert_close(surface_volume(z) / surface_volume(s), 1.0, 1e-11);
    mesh_case_end(&one, &s);
    mesh_case_end(&all, &z);
}

TEST(restart_is_exact)
{
    struct mesh_case one, two;
    start_column(&one, MPI_COMM_WORLD);
    struct fv *s = fv_create(&one.run, NULL);
    start_column(&two, MPI_COMM_WORLD);
    assert_int_equal(mesh_case_restart(&one, s, &two, 6), 0);
}

/* A tank that falls freely: its water goes with it. */
TEST(water_falls_with_its_tank)
{
    static const char falls[] = "{ name = \"tank\"; cells = (12, 24); max = (0.5, 1.0); " SLIP
                                "motion = ( { kind = \"polynomial\"; axis = \"y\"; coefficients = "
                                "(0, 0, -4.905); until = 0.3; } ); }";
    for (int q = 0; q < 3; q++) {
        struct mesh_case c;
        struct fv *s = start(&c, MPI_COMM_WORLD, falls,
                             (const char *const[]){HEAVY, THIN, steps[q], NULL}, 0.5);
        double off = 0.0;
        assert_true(mesh_case_run(s, 100, 0.2));
        FLOW_ROWS (s, k, n)
            for (int64_t i = k; i < k + n; i++)
                off = fmax(off, s->surface->layer[i] ? 0.0 : fabs(s->u[1][i] + 9.81 * s->t));
        MPI_Allreduce(MPI_IN_PLACE, &off, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        print_message("%s: t = %.3g s, velocity off by %.3g\n", steps[q], s->t,
                      off / (9.81 * s->t));
        assert_close(off / (9.81 * s->t), 0.0, 1e-3);
        mesh_case_end(&c, &s);
    }
}

/* A tank at rest that falls at 0.5 m/s from one instant to another: its water goes with it at once,
 * and stays level, to 0.1 % of that; the same where a restart has made the walls anew. */
TEST(water_starts_and_stops_with_its_tank)
{
    static const char falls[] =
        "{ name = \"tank\"; cells = (20, 14); max = (1.0, 0.7); " SLIP
        "motion = ( { kind = \"polynomial\"; axis = \"y\"; coefficients = (0.0, -0.5); from = 0.1; "
        "until = 0.3; } ); }";
    for (int q = 0; q < (SANITIZED ? 1 : 3); q++) {
        struct mesh_case c;
        struct fv *s = start(&c, MPI_COMM_WORLD, falls,
                             (const char *const[]){HEAVY, THIN, steps[q], NULL}, 0.363);
        const double volume = surface_volume(s);
        assert_true(mesh_case_run(s, 1000, 0.1));
        s->sides->set = false;
        s->m->turn = INFINITY;
        mesh_motion_place(s->m, s->t);
        mesh_bc_time(s, s->t);
        assert_true(mesh_case_run(s, 1000, 0.2));
        assert_close(s->u[1][part_at(s->grid.part, 0, 0, 0)], -0.5, 5e-4);
        assert_true(mesh_case_run(s, 1000, 0.4));
        assert_true(s->max.u[0] < 5e-4);
        assert_close((fabs(s->surface->lost) + fabs(s->surface->gained)) / volume, 0.0, 1e-3);
        mesh_case_end(&c, &s);
    }
}
