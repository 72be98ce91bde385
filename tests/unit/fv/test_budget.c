/* test_budget.c - what the operators do to the momentum of the flow is what it does to the walls;
 * the divergence of the fluxes is what the solver leaves. ranks: 1 4.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/time/stages.h"
#include "fv_bc_case.h"
#include "mesh_case.h"

/* sums[a]: rho times the volume integral of -N + nu Lap u - grad p along a; sums[3]: the largest of
 * the three alone. */
static void rates(struct fv *s, double sums[4])
{
    const double rho = s->run->scene.fluid.rho;
    memset(sums, 0, 4 * sizeof(double));
    memcpy(s->p_before, s->p, (size_t)s->size * sizeof(double));
    sides_velocity(s, BC_GIVEN, s->u);
    s->ops->convection(s, s->stages.N);
    grid_fill(&s->grid, 1, &s->p);
    s->ops->pressure_gradient(s, s->p, s->stages.step_p);
    for (int a = 0; a < s->dim; a++) {
        double part[3] = {0.0, 0.0, 0.0};
        s->ops->viscous(s, a, s->rhs[a]);
        FLOW_ROWS (s, c, n)
            for (int64_t i = c; i < c + n; i++) {
                const double V = grid_volume(&s->grid, i) * (s->free ? s->free[i] : 1.0);
                part[0] -= rho * V * s->stages.N[a][i];
                part[1] += rho * V * s->rhs[a][i];
                part[2] -= rho * V * s->stages.step_p[a][i];
            }
        MPI_Allreduce(MPI_IN_PLACE, part, 3, MPI_DOUBLE, MPI_SUM, s->comm);
        sums[a] = part[0] + part[1] + part[2];
        for (int k = 0; k < 3; k++)
            sums[3] = fmax(sums[3], fabs(part[k]));
    }
}

static void force_of(struct fv *s, double *force)
{
    double all[4];
    flow_forces(s, NULL, all);
    memcpy(force, all, 3 * sizeof(double));
}

/* Vortices in a duct: along it the walls take what the flow loses; in a box both ways. */
TEST(walls_take_what_the_flow_loses)
{
    double sums[4], force[3];
    struct fv_case c;
    fv_case_set(
        &c, MPI_COMM_WORLD,
        (const char *const[]){"initial.field=\"two_modes\"", "domain.periodic=(true,false)", NULL});
    wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 0.3);
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 8, 100.0));
    rates(s, sums);
    force_of(s, force);
    print_message("duct, uniform grid: %g of %g\n", sums[0] + force[0], sums[3]);
    assert_true(fabs(force[0]) > 1e-3 && fabs(sums[0] + force[0]) < 1e-10 * sums[3]);
    fv_free(&c.s);
}

/* The same of all four walls of a cavity, pressures in its corners too, whose steady sum is 0; also
 * where friction reaches over many cells in a step (Re 1). */
static void cavity(const char *nu, double steady)
{
    double sums[4], force[3];
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){CLOSED, "initial.field=\"rest\"", nu, NULL});
    for (int side = SIDE_X_MIN; side <= SIDE_Y_MAX; side++)
        wall_add(&c, (enum scene_side)side, WALL_NO_SLIP, side == SIDE_Y_MAX ? 1.0 : 0.0);
    struct fv *s = fv_case_start(&c, NULL);
    for (int k = 0; k < 2; k++) {
        assert_true(fv_case_run(&c, 100000, k ? steady : steady / 60.0)); /* 2.4 L^2/nu */
        rates(s, sums);
        force_of(s, force);
        for (int a = 0; a < 2; a++) {
            print_message("cavity, t = %g s, %c: %g of %g, force %g\n", s->t, "xy"[a],
                          sums[a] + force[a], sums[3], force[a]);
            assert_true(fabs(sums[a] + force[a]) < 1e-10 * sums[3]);
            assert_true(!k || fabs(force[a]) < 1e-3 * sums[3]);
        }
    }
    fv_free(&c.s);
}

TEST(so_do_walls_of_a_cavity)
{
    cavity("fluid.nu=0.02", 12.0);
    cavity("fluid.nu=1", 2.4);
}

/* Largest divergence in units of the speed 1 over a cell of 1/32. */
static double largest_divergence(struct fv *s)
{
    double div = 0.0;
    mesh_divergence(s, s->U, s->flux);
    FLOW_ROWS (s, at, n)
        for (int64_t i = at; i < at + n; i++)
            div = fmax(div, fabs(s->flux[i]) * 32.0);
    return ranks_max(s->comm, div);
}

#define UNEVEN "mapping = \"stretched\"; stretch = (-1.0, -1.0); "
/* In a box and along a duct whose walls go on over joins, periods and cuts between ranks: fluxes
 * beside a wall are the same on both sides of them. */
TEST(so_do_walls_of_blocks)
{
    static const struct {
        const char *name, *blocks, *periodic, *dim;
        int along;
    } flows[] = {
        {"box",
         "{ name = \"a\"; cells = (32, 32); max = (1.0, 1.0); i_min = \"wall\"; i_max = "
         "\"wall\"; j_min = \"wall\"; j_max = \"wall\"; }",
         "domain.periodic=(false,false)", "domain.dim=2", 2},
        {"box of two, one turned",
         "{ name = \"a\"; cells = (16, 24); max = (0.5, 1.0); i_min = \"wall\"; i_max = "
         "\"joined\"; j_min = \"wall\"; j_max = \"wall\"; }, { name = \"b\"; cells = (24, 16); "
         "min = (0.25, 0.25); max = (1.25, 0.75); centre = (0.75, 0.5); angle = 90.0; i_min = "
         "\"wall\"; i_max = \"wall\"; j_min = \"wall\"; j_max = \"joined\"; }",
         "domain.periodic=(false,false)", "domain.dim=2", 2},
        {"duct",
         "{ name = \"a\"; cells = (32, 16); max = (1.0, 1.0); i_min = \"periodic\"; i_max = "
         "\"periodic\"; j_min = \"wall\"; j_max = \"wall\"; }",
         "domain.periodic=(true,false)", "domain.dim=2", 1},
        {"duct of two",
         "{ name = \"a\"; " UNEVEN "cells = (16, 24); max = (0.5, 1.0); i_min = \"periodic\"; "
         "i_max = \"joined\"; j_min = \"wall\"; j_max = \"wall\"; }, { name = \"b\"; " UNEVEN
         "cells = (16, 24); min = (0.5, 0.0); max = (1.0, 1.0); i_min = \"joined\"; i_max = "
         "\"periodic\"; j_min = \"wall\"; j_max = \"wall\"; }",
         "domain.periodic=(true,false)", "domain.dim=2", 1},
        {"duct of four walls",
         "{ name = \"a\"; cells = (12, 8, 8); max = (1.0, 1.0, 1.0); i_min = \"periodic\"; i_max = "
         "\"periodic\"; j_min = \"wall\"; j_max = \"wall\"; k_min = \"wall\"; k_max = \"wall\"; }",
         "domain.periodic=(true,false,false)", "domain.dim=3", 1}};
    for (int k = 0; k < (int)(sizeof flows / sizeof *flows); k++) {
        double sums[4], force[3];
        struct mesh_case m;
        struct fv *s = mesh_case_start(
            &m, MPI_COMM_WORLD, flows[k].blocks,
            (const char *const[]){"fv.tol_pressure=1e-11", flows[k].periodic, flows[k].dim, NULL});
        assert_true(mesh_case_run(s, 8, 100.0));
        rates(s, sums);
        force_of(s, force);
        const double div = largest_divergence(s);
        print_message("%s: %g %g of %g, divergence %g\n", flows[k].name, sums[0] + force[0],
                      sums[1] + force[1], sums[3], div);
        for (int a = 0; a < flows[k].along; a++)
            assert_true(fabs(force[a]) > 1e-5 && fabs(sums[a] + force[a]) < 1e-10 * sums[3]);
        assert_true(div < 1e-11);
        mesh_case_end(&m, &s);
    }
}

/* Between two cylinders, from a flow that knows nothing of them. */
TEST(so_do_curved_walls)
{
    double sums[4], force[3];
    struct mesh_case c;
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD,
        "{ name = \"ring\"; mapping = \"annulus\"; centre = (0.1, 0.05); radius = (0.5, 1.0); "
        "cells = (12, 48); i_min = \"wall\"; i_max = \"wall\"; j_min = \"joined\"; "
        "j_max = \"joined\"; }",
        (const char *const[]){"fluid.nu=0.05", NULL});
    assert_true(mesh_case_run(s, 1000, 0.1));
    rates(s, sums);
    force_of(s, force);
    print_message("ring: force %g %g, missing %g %g of %g\n", force[0], force[1],
                  sums[0] + force[0], sums[1] + force[1], sums[3]);
    for (int a = 0; a < 2; a++)
        assert_true(fabs(force[a]) > 1e-3 && fabs(sums[a] + force[a]) < 1e-10 * sums[3]);
    mesh_case_end(&c, &s);
}
