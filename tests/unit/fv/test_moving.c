/* test_moving.c - blocks that move: uniform flow, a known flow, walls, faults. ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/operators/flow_measures.h"
#include "../../../fv/operators/viscous_solver.h"
#include "mesh_case.h"

#define BACK "{ name = \"back\"; cells = (24, 24); " PERIODIC " }, "
#define SWING                                                                                      \
    "motion = ( { kind = \"harmonic\"; axis = \"x\"; amplitude = 0.3; period = 0.7; }, "           \
    "{ kind = \"polynomial\"; axis = \"rz\"; coefficients = (0.0, 2.0); } );"

static double distance_from_uniform(const struct fv *s)
{
    double worst = 0.0;
    for (int64_t i = 0; i < s->size; i++)
        for (int a = 0; a < s->dim && s->free[i] > 0.0; a++)
            worst = fmax(worst, fabs(s->u[a][i] - s->run->scene.initial.velocity[a]));
    return ranks_max(s->comm, worst);
}

/* Geometric conservation: blocks that swing and turn leave a uniform flow alone, to rounding. */
TEST(uniform_flow_stays)
{
    static const char *const blocks[2] = {
        BACK "{ name = \"turned\"; cells = (16, 16); min = (0.2, 0.2); max = (0.8, 0.8); centre = "
             "(0.5, 0.5); angle = 30.0; " SWING " }",
        "{ name = \"back\"; cells = (14, 14, 14); " PERIODIC
        "k_min = \"periodic\"; k_max = \"periodic\"; }, "
        "{ name = \"cube\"; mapping = \"sheared\"; wave = 0.03; cells = (10, 10, 10); min = (0.2, "
        "0.2, 0.2); max = (0.8, 0.8, 0.8); centre = (0.5, 0.5, 0.5); motion = ( { kind = "
        "\"polynomial\"; axis = \"rx\"; coefficients = (0.3, 1.0); }, { kind = \"polynomial\"; "
        "axis = \"z\"; coefficients = (0.0, 0.5); } ); }"};
    static const char *const integrators[4] = {"fv.integrator=\"rk3\"", "fv.integrator=\"bdf2\"",
                                               "fv.integrator=\"rk3\"", "fv.integrator=\"newton\""};
    for (int k = 0; k < 4; k++) {
        struct mesh_case c;
        const char *const overrides[] = {"initial.field=\"uniform\"", integrators[k],
                                         k == 2 ? "domain.dim=3" : NULL, NULL};
        struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, blocks[k == 2], overrides);
        const int a = k == 2 ? 2 : 0;
        const double x = s->m->block[1].x[0][a];
        const bool good = mesh_case_run(s, SANITIZED ? 1 : k == 2 ? 2 : 8, 100.0);
        const double worst = distance_from_uniform(s);
        const bool moved = fabs(s->m->block[1].x[0][a] - x) > 1e-3;
        const double share = mesh_case_energy_share(s);
        mesh_case_end(&c, &s);
        print_message("uniform flow, %s: %.2g off, %.4f of its energy\n", integrators[k], worst,
                      share);
        assert_close(share, 1.0, 0.03); /* what blocks share counts once, by its cells' centres */
        assert_true(good && moved && worst < (k == 3 ? 1e-6 : 1e-13));
    }
}

/* The flux of the grid through the faces of a cell sums to zero, of turning cells, too. */
TEST(cells_keep_their_volume)
{
    struct mesh_case c;
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD,
        BACK
        "{ name = \"ring\"; mapping = \"annulus\"; radius = (0.06, 0.45); stretch = (1.0, 0.0); "
        "cells = (14, 40); centre = (0.5, 0.5); i_min = \"slip\"; j_min = \"joined\"; j_max = "
        "\"joined\"; " SWING " }",
        (const char *const[]){"initial.field=\"rest\"", NULL});
    struct mesh *m = s->m;
    double worst = 0.0, largest = 0.0, S = 0.0;
    mesh_motion_place(m, 0.23);
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        int i[3];
        PART_CELLS (p, i, at) {
            double net = 0.0, closed = 0.0;
            if (p->block != 1)
                continue;
            for (int a = 0; a < 2; a++) {
                net += m->grid[a][at + p->stride[a]] - m->grid[a][at];
                closed += m->S[a][0][at + p->stride[a]] - m->S[a][0][at];
                largest = fmax(largest, fabs(m->grid[a][at]));
            }
            worst = fmax(worst, fabs(net));
            S = fmax(S, fabs(closed));
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    mesh_case_end(&c, &s);
    assert_true(largest > 1e-3 && worst < 1e-15 && S < 1e-15);
}

/* Vortices that a block passes by: a tenth more error than with the block at rest in bdf2, second
 * order in the step in rk3. */
TEST(a_known_flow_is_kept)
{
    static const char rest[] =
        BACK "{ name = \"box\"; cells = (16, 16); min = (0.2, 0.2); max = (0.8, 0.8); }";
    static const char moves[] =
        BACK "{ name = \"box\"; cells = (16, 16); min = (0.2, 0.2); max = (0.8, 0.8); motion = ( { "
             "kind = \"polynomial\"; axis = \"x\"; coefficients = (0.0, 1.0); } ); }";
    double e[2][3];
    const char *const rk3[] = {"fv.cfl=0.6", NULL};
    mesh_case_errors(rest, rk3, 0.1, e[0]);
    mesh_case_errors(moves, rk3, 0.1, e[1]);
    assert_true(e[1][0] < 1.2 * e[0][0]);
    if (SANITIZED)
        return;
    const char *const bdf2[] = {"fv.integrator=\"bdf2\"", "fv.cfl=0.3", NULL};
    mesh_case_errors(rest, bdf2, 0.1, e[0]);
    mesh_case_errors(moves, bdf2, 0.1, e[1]);
    assert_true(e[1][0] < 1.1 * e[0][0]);
    const char *const newton[] = {"fv.integrator=\"newton\"", "fv.cfl=0.25", NULL};
    mesh_case_errors(rest, newton, 0.1, e[0]);
    mesh_case_errors(moves, newton, 0.1, e[1]);
    print_message("newton: %.3g at rest, %.3g past a block that moves\n", e[0][0], e[1][0]);
    assert_true(e[1][0] < 1.1 * e[0][0]);
}

#define WALLED                                                                                     \
    "{ name = \"back\"; cells = (32, 32); min = (-1, -1); max = (1, 1); i_min = \"slip\"; i_max "  \
    "= \"slip\"; j_min = \"slip\"; j_max = \"slip\"; }, { name = \"ring\"; mapping = "             \
    "\"annulus\"; radius = (0.2, 0.85); cells = (16, 32); i_min = \"wall\"; j_min = \"joined\"; "  \
    "j_max = \"joined\"; "

static void moment_of(const char *blocks, double *moment, double *size)
{
    struct mesh_case c;
    double force[FLOW_BODIES_MAX][4], all[4];
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD, blocks,
        (const char *const[]){"initial.field=\"rest\"", "fluid.nu=0.05", "fv.tol_pressure=1e-6",
                              "domain.min=(-1,-1)", "domain.max=(1,1)", NULL});
    bool good = true;
    for (int k = 1; k <= 10; k++) /* no flow bounds the steps of a wall that slides */
        good = mesh_case_run(s, 100, 0.01 * k) && good;
    flow_forces(s, force, all);
    *moment = good ? force[1][3] : NAN;
    *size = hypot(force[1][0], force[1][1]);
    mesh_case_end(&c, &s);
}

/* A ring that turns with its wall makes the flow of one at rest whose wall spins. */
TEST(a_turning_block_is_a_spinning_wall)
{
    double moment[2], size[2];
    moment_of(WALLED "spin = (2.0, 0.0); }", moment, size);
    moment_of(WALLED "motion = ( { kind = \"polynomial\"; axis = \"rz\"; coefficients = (0.0, "
                     "2.0); } ); }",
              moment + 1, size + 1);
    assert_true(moment[0] < -1e-3 && fabs(moment[1] / moment[0] - 1.0) < 1e-2);
    assert_true(size[1] < 0.01 * fabs(moment[1]));
}

/* A ring that starts in a fluid so viscous that the flow sets no step: friction does, all the way.
 */
TEST(friction_bounds_the_step)
{
    struct mesh_case c;
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD,
        WALLED "motion = ( { kind = \"harmonic\"; axis = \"rz\"; amplitude = 0.1; period = 0.1; "
               "} ); }",
        (const char *const[]){"initial.field=\"rest\"", "fluid.nu=50", "domain.min=(-1,-1)",
                              "domain.max=(1,1)", NULL});
    for (int k = 0; k < 3; k++) {
        assert_true(mesh_case_run(s, 1, 0.1));
        assert_true(s->step.dt * viscous_stiffest(s) < 240.0 * (1.0 + 1e-9));
        assert_true(s->step.dt * viscous_stiffest(s) > 60.0 * (1.0 - 0.1));
    }
    mesh_case_end(&c, &s);
}

/* A ring that shakes by a thousandth of its cells, later than the run starts: the flow would allow
 * one step for all of it. Each period gets 40 steps, each step at most 0.1 rad, and one step ends
 * where the motion starts. */
TEST(steps_see_the_motion)
{
    static const struct {
        const char *motion;
        double most, from;
    } of[] = {{"kind = \"harmonic\"; axis = \"rz\"; amplitude = 1e-4; period = 1.0;", 0.025, 0.0},
              {"kind = \"polynomial\"; axis = \"rz\"; coefficients = (0.0, 0.4); from = 0.3;", 0.25,
               0.3}};
    for (size_t k = 0; k < sizeof of / sizeof of[0]; k++) {
        struct mesh_case c;
        char blocks[1024];
        bool met = of[k].from == 0.0;
        snprintf(blocks, sizeof blocks, "%smotion = ( { %s } ); }", WALLED, of[k].motion);
        struct fv *s =
            mesh_case_start(&c, MPI_COMM_WORLD, blocks,
                            (const char *const[]){"initial.field=\"rest\"", "fluid.nu=1e-3",
                                                  "domain.min=(-1,-1)", "domain.max=(1,1)", NULL});
        for (int n = 0; n < 12 && s->t < 0.99; n++) {
            assert_true(mesh_case_run(s, 1, 1.0));
            met = met || fabs(s->t - of[k].from) < 1e-12;
            assert_true(s->t <= of[k].from + 1e-12 || s->step.dt <= of[k].most * (1.0 + 1e-9));
        }
        assert_true(met);
        mesh_case_end(&c, &s);
    }
}

/* What cannot move is refused, with the time if it is on the way. */
TEST(faults_are_told)
{
    static const struct {
        const char *blocks, *override, *wanted;
    } of[] = {
        {WALLED "motion = ( { kind = \"polynomial\"; axis = \"x\"; coefficients = (0.0, 1.0); } ); "
                "}",
         "fv.cfl=1.0", "reaches out of the domain"},
        {WALLED "motion = ( { kind = \"polynomial\"; axis = \"x\"; coefficients = (0.0, 0.1); } ); "
                "}",
         "fv.steady=true", "no steady state"},
        {WALLED "motion = ( { kind = \"harmonic\"; axis = \"z\"; amplitude = 0.1; period = 1.0; } "
                "); }",
         "fv.cfl=1.0", "axis z in a case of 2 dimensions"},
        {WALLED "motion = ( { kind = \"harmonic\"; axis = \"x\"; amplitude = 0.1; } ); }",
         "fv.cfl=1.0", "needs an amplitude and a period"}};
    for (size_t k = 0; k < sizeof of / sizeof of[0]; k++) {
        struct mesh_case c;
        mesh_case_read(&c, MPI_COMM_WORLD, of[k].blocks,
                       (const char *const[]){"initial.field=\"rest\"", "domain.min=(-1,-1)",
                                             "domain.max=(1,1)", of[k].override, NULL});
        assert_true(mesh_case_refused(&c, of[k].wanted));
    }
}
