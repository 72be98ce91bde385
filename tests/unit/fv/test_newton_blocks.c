/* test_newton_blocks.c - Newton's method on joined, curved and overlapping blocks. ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/time/newton.h"
#include "mesh_case.h"
#include "newton_case.h"

#define NEWTON "fv.integrator=\"newton\""
#define STEADY NEWTON, "fv.steady=true", "initial.field=\"couette\""
#define RING(cells)                                                                                \
    "{ name = \"ring\"; mapping = \"annulus\"; i_min = \"wall\"; i_max = \"wall\"; j_min = "       \
    "\"joined\"; "                                                                                 \
    "j_max = \"joined\"; radius = (0.5, 1.0); spin = (2.0, -0.5); cells = " cells "; }"

static const char plain[] = "{ name = \"a\"; cells = (24, 24); " PERIODIC "}";
static const char joined[] =
    "{ name = \"w\"; cells = (12, 24); max = (0.5, 1.0); i_min = \"periodic\"; i_max = \"joined\"; "
    "j_min = \"periodic\"; j_max = \"periodic\"; }, "
    "{ name = \"e\"; cells = (12, 24); min = (0.5, 0.0); max = (1.0, 1.0); i_min = \"joined\"; "
    "i_max = "
    "\"periodic\"; j_min = \"periodic\"; j_max = \"periodic\"; }";
static const char overlapping[] =
    "{ name = \"square\"; cells = (24, 24); " PERIODIC
    "}, { name = \"turned\"; cells = (16, 16); min = "
    "(0.22, 0.22); max = (0.78, 0.78); centre = (0.5, 0.5); angle = 30.0; }";

TEST(steady_ring_has_order_three_and_a_half)
{
    double coarse[3], fine[3];
    mesh_case_errors(RING("(8, 32)"), (const char *const[]){STEADY, NULL}, 1.0, coarse);
    mesh_case_errors(RING("(16, 64)"), (const char *const[]){STEADY, NULL}, 1.0, fine);
    print_message("velocity %.3g, %.3g, pressure %.3g, %.3g\n", coarse[0], fine[0], coarse[1],
                  fine[1]);
    assert_true(log2(coarse[0] / fine[0]) > 3.5 && log2(coarse[1] / fine[1]) > 3.0);
}

/* Joints change nothing but the order of sums; an overlap little. */
TEST(joints_do_not_matter)
{
    static const char *const common[] = {NEWTON, "fv.cfl=2", NULL};
    double one[3], two[3], over[3];
    mesh_case_errors(plain, common, 0.2, one);
    mesh_case_errors(joined, common, 0.2, two);
    mesh_case_errors(overlapping, common, 0.2, over);
    print_message("velocity: %.6g, joined %.6g, overlapping %.6g\n", one[0], two[0], over[0]);
    assert_close(two[0], one[0], 1e-3);
    assert_close(over[0], one[0], 0.2);
}

/* Mean kinetic energy after a second of a weakly compressible flow; vectors an iteration. */
static double energy_with_sound(const char *blocks, const char *c0, double *vectors)
{
    struct mesh_case c;
    double sums[2] = {0.0, 0.0};
    struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, blocks,
                                   (const char *const[]){NEWTON, "fv.cfl=2", c0, NULL});
    assert_true(mesh_case_run(s, 1000, 0.3));
    FLOW_ROWS (s, at, n)
        for (int64_t i = at; i < at + n; i++) {
            sums[0] += s->free[i] * s->m->V[i];
            sums[1] +=
                s->free[i] * s->m->V[i] * (s->u[0][i] * s->u[0][i] + s->u[1][i] * s->u[1][i]);
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    *vectors = (double)s->newton->krylovs / (double)s->newton->newtons;
    mesh_case_end(&c, &s);
    return sums[1] / sums[0];
}

/* Of the order of the Mach number's square, on all blocks alike. */
TEST(sound_changes_little)
{
    static const char *const blocks[3] = {plain, joined, overlapping};
    double change[3];
    for (int k = 0; k < 3; k++) {
        double vectors[2];
        const double none = energy_with_sound(blocks[k], NULL, vectors);
        change[k] = energy_with_sound(blocks[k], "fv.c0=10", vectors + 1) / none - 1.0;
        print_message("c = 10 U: energy %.3g, vectors %.3g (%.3g)\n", change[k], vectors[1],
                      vectors[0]);
        assert_true(fabs(change[k]) > 1e-6 && fabs(change[k]) < 1e-2);
        assert_true(vectors[1] < 2.0 * vectors[0] + 2.0);
    }
    assert_close(change[1] / change[0], 1.0, 1e-2);
}

/* Also where blocks overlap. */
TEST(preconditioner_is_linear)
{
    struct mesh_case c;
    struct fv *s =
        mesh_case_start(&c, MPI_COMM_WORLD, overlapping, (const char *const[]){NEWTON, NULL});
    const double error = newton_precond_bends(s);
    print_message("%.3g\n", error);
    assert_true(error < 1e-11);
    mesh_case_end(&c, &s);
}

/* From rest, between an inflow, slip walls and an outflow, where the pressure is given. */
TEST(a_stream_becomes_uniform)
{
    static const char duct[] = "{ name = \"duct\"; mapping = \"stretched\"; stretch = (-1.5, 0); "
                               "min = (-2, -0.5); max = (2, 0.5); cells = "
                               "(24, 12); velocity = (1, 0); i_min = \"inflow\"; i_max = "
                               "\"outflow\"; j_min = \"slip\"; j_max = \"slip\"; }";
    struct mesh_case c;
    double most = 0.0;
    struct fv *s =
        mesh_case_start(&c, MPI_COMM_WORLD, duct,
                        (const char *const[]){NEWTON, "fv.steady=true", "initial.field=\"rest\"",
                                              "fluid.nu=0.01", NULL});
    assert_true(mesh_case_run(s, 1000, 1.0) && s->newton->steady);
    FLOW_ROWS (s, at, n)
        for (int64_t i = at; i < at + n; i++)
            most = fmax(most, hypot(s->u[0][i] - 1.0, s->u[1][i]));
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    print_message("%.3g off a uniform stream, %lld iterations\n", most,
                  (long long)s->newton->newtons);
    assert_true(most < 1e-4);
    mesh_case_end(&c, &s);
}

/* Walls and openings of the scene are the sides of a block that has none of its own: a parabolic
 * inflow, no-slip walls and a given pressure at the end, a parabola everywhere. */
TEST(walls_of_the_scene_make_a_duct)
{
    static const char duct[] = "{ name = \"duct\"; mapping = \"stretched\"; stretch = (0, -1.2); "
                               "min = (-2, -2); max = (2, 2); cells = (12, 16); }";
    static const struct scene_wall walls[] = {
        {.side = SIDE_X_MIN,
         .kind = WALL_INFLOW,
         .velocity = {1.0, 0.0, 0.0},
         .profile = PROFILE_PARABOLIC},
        {.side = SIDE_X_MAX, .kind = WALL_OUTFLOW, .pressure = 3.0},
        {.side = SIDE_Y_MIN, .kind = WALL_NO_SLIP},
        {.side = SIDE_Y_MAX, .kind = WALL_NO_SLIP}};
    struct mesh_case c;
    double most = 0.0, pressure = 0.0;
    mesh_case_read(&c, MPI_COMM_WORLD, duct,
                   (const char *const[]){NEWTON, "fv.steady=true", "initial.field=\"rest\"",
                                         "fluid.nu=0.1", NULL});
    memcpy(c.run.scene.walls, walls, sizeof walls);
    c.run.scene.nwalls = 4;
    struct fv *s = mesh_case_create(&c, NULL);
    assert_true(mesh_case_run(s, 1000, 1.0) && s->newton->steady);
    for (int q = 0; q < s->grid.nparts; q++) {
        const struct part *p = s->grid.part + q;
        const struct mesh_block *b = s->m->block;
        int i[3];
        PART_CELLS (p, i, at) {
            static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
            const int cell[3] = {p->lo[0] + i[0], p->lo[1] + i[1], 0};
            double x = 0.0, u = 0.0;
            for (int g = 0; g < 2; g++) { /* an average over the index, as the unknown is */
                double at_point[3], slopes[3][3];
                mesh_map_point(b, 2, cell, (const double[]){0.5, gauss[g], 0.5}, at_point, slopes);
                const double y = (at_point[1] + 2.0) / 4.0;
                u += 0.5 * 4.0 * y * (1.0 - y);
                x = at_point[0];
            }
            most = fmax(most, fabs(s->u[0][at] - u));
            pressure =
                fmax(pressure, fabs(s->p[at] - 3.0 - 0.05 * (2.0 - x))); /* 8 nu U/H^2 = 0.05 */
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &pressure, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    print_message("%.3g off the parabola, pressure %.3g off\n", most, pressure);
    assert_true(most < 1e-3 && pressure < 1e-3);
    mesh_case_end(&c, &s);
}

/* One that no block can take is a mistake of the case. */
TEST(a_wall_without_a_block_is_refused)
{
    struct mesh_case c;
    mesh_case_read(&c, MPI_COMM_WORLD, plain, (const char *const[]){NEWTON, NULL});
    c.run.scene.walls[0] = (struct scene_wall){.side = SIDE_X_MIN, .kind = WALL_NO_SLIP};
    c.run.scene.nwalls = 1;
    assert_true(mesh_case_refused(&c, "no side of a block"));
}
