/* test_given.c - cells of blocks whose velocity is given: a hole with the exact solution in joined,
 * waving and overlapping blocks. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "mesh_case.h"

#define HOLE "fv.hole=((0.3125,0.3125),(0.6875,0.6875))"

static const char joined[] =
    "{ name = \"a\"; cells = (%d, %d); max = (0.5, 1.0); i_min = \"periodic\"; i_max = \"joined\"; "
    "j_min = \"periodic\"; j_max = \"periodic\"; }, "
    "{ name = \"b\"; cells = (%d, %d); min = (0.5, 0.0); max = (1.0, 1.0); centre = (0.75, 0.5); "
    "angle = 180.0; i_max = \"joined\"; i_min = \"periodic\"; j_max = \"periodic\"; j_min = "
    "\"periodic\"; }";
static const char waving[] =
    "{ name = \"a\"; mapping = \"sheared\"; wave = 0.06; cells = (%d, %d); " PERIODIC "}";
static const char turned[] =
    "{ name = \"back\"; cells = (%d, %d); " PERIODIC
    "}, { name = \"turned\"; cells = (%d, %d); min = (0.25, 0.25); max = (0.75, 0.75); centre = "
    "(0.5, 0.5); angle = 30.0; }";

/* Order of the velocity from 32 to 64 cells along y; its error on the finer grid. */
static double order(const char *blocks, bool halves, const char *hole, double *fine)
{
    double e[2][3];
    for (int k = 0; k < 2; k++) {
        const int n = (SANITIZED ? 16 : 32) << k, half = n / 2;
        char text[1024];
        if (blocks == joined)
            snprintf(text, sizeof text, joined, half, n, half, n);
        else if (halves)
            snprintf(text, sizeof text, turned, n, n, half, half);
        else
            snprintf(text, sizeof text, waving, n, n);
        mesh_case_errors(text, (const char *const[]){hole, NULL}, 0.25, e[k]);
    }
    *fine = e[1][0];
    print_message("hole: u %.2e %.2e p %.2e %.2e\n", e[0][0], e[1][0], e[0][1], e[1][1]);
    return log2(e[0][0] / e[1][0]);
}

TEST(a_hole_keeps_the_order)
{
    double fine;
    assert_true(order(joined, false, HOLE, &fine) > (SANITIZED ? 2.5 : 3.5));
    assert_true(fine < (SANITIZED ? 1e-2 : 1.5e-4));
    assert_true(order(waving, false, HOLE, &fine) > (SANITIZED ? 2.5 : 3.5));
    assert_true(fine < (SANITIZED ? 1e-2 : 3e-4));
}

/* Its outline crosses that of the overlap: cells of the fringe beside it take what it knows. */
TEST(across_an_overlap_too)
{
    double fine;
    assert_true(order(turned, true, "fv.hole=((0.2,0.2),(0.45,0.45))", &fine) >
                (SANITIZED ? 1.5 : 2.9));
    assert_true(fine < (SANITIZED ? 1e-2 : 4e-4));
}

/* In three dimensions, and what flows out of the hole is what flows in. */
TEST(a_uniform_flow_passes)
{
    struct mesh_case c;
    double worst = 0.0, net = 0.0;
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD,
        "{ name = \"a\"; mapping = \"sheared\"; wave = 0.05; cells = (12, 12, 12); " PERIODIC
        "k_min = \"periodic\"; k_max = \"periodic\"; }",
        (const char *const[]){"domain.dim=3", "initial.field=\"uniform\"",
                              "fv.hole=((0.2,0.2,0.2),(0.7,0.7,0.7))", NULL});
    assert_true(s->m->given_cells > 60);
    const bool good = mesh_case_run(s, 3, 100.0);
    for (int64_t i = 0; i < s->size; i++)
        for (int a = 0; a < 3 && s->free[i] > 0.0; a++)
            worst = fmax(worst, fabs(s->u[a][i] - s->run->scene.initial.velocity[a]));
    for (int a = 0; a < 3; a++)
        for (int64_t i = 0; i < s->forcing->nface[a]; i++)
            if (s->forcing->counts[a][i])
                net += s->forcing->sign[a][i] * s->U[a][s->forcing->face[a][i]];
    mesh_case_end(&c, &s);
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &net, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    assert_true(good && worst < 1e-12 && fabs(net) < 1e-14);
}

/* A partner's part that ends at the upper side, over a source of 1/s: what flows through its
 * outline is what flows through the sides, and nothing is left for the other cells. */
TEST(an_outline_may_end_at_sides)
{
    struct mesh_case c;
    double net = 0.0, most = 0.0;
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD,
        "{ name = \"a\"; mapping = \"sheared\"; shear = 0.3; cells = (16, 16); i_min = "
        "\"periodic\"; i_max = \"periodic\"; j_min = \"exact\"; j_max = \"exact\"; }",
        (const char *const[]){"domain.periodic=(true,false)", "initial.field=\"uniform\"",
                              "initial.velocity=(0.5,0)", "fv.hole=((0,0.5),(1,1))", NULL});
    DROP(s->forcing);
    struct forcing *f = s->forcing = mem_own(s, forcing_create(s, 0, NULL, true));
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        double x[3];
        grid_place(&s->grid, f->partner[i], x);
        f->v[1][i] = f->v_next[1][i] = x[1];
    }
    forcing_fluxes(s, 0.0, s->U);
    for (int a = 0; a < 2; a++)
        for (int64_t i = 0; i < f->nface[a]; i++)
            if (f->counts[a][i]) {
                net += f->sign[a][i] * s->U[a][f->face[a][i]];
                most = fmax(most, fabs(s->U[a][f->face[a][i]]));
            }
    MPI_Allreduce(MPI_IN_PLACE, &net, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    print_message("outline: net %.3g, sides %.3g, most %.3g\n", net, mesh_bc_net_flux(s), most);
    assert_true(f->net == NET_SIDES && fabs(net + mesh_bc_net_flux(s)) < 1e-14);
    mesh_case_end(&c, &s);
}

/* Newton's method: the errors of time rule, as without a hole. */
TEST(newton_goes_round_it)
{
    static const char *const of[2] = {waving, joined};
    for (int k = 0; k < 2; k++) {
        static const char *const hole[2] = {HOLE, NULL};
        double e[2][3];
        char text[1024];
        snprintf(text, sizeof text, of[k], k ? 12 : 24, 24, 12, 24);
        for (int none = 0; none < 2; none++)
            mesh_case_errors(
                text,
                (const char *const[]){"fv.integrator=\"newton\"", "fv.cfl=1", hole[none], NULL},
                0.125, e[none]);
        print_message("newton: u %.2e (no hole %.2e) p %.2e (%.2e)\n", e[0][0], e[1][0], e[0][1],
                      e[1][1]);
        assert_true(e[0][0] < 1.2 * e[1][0] && e[0][1] < 1.2 * e[1][1]);
    }
}

/* The steady march round a hole in a ring between walls that turn. */
TEST(so_does_a_steady_march)
{
    static const char ring[] =
        "{ name = \"ring\"; mapping = \"annulus\"; i_min = \"wall\"; i_max = \"wall\"; j_min = "
        "\"joined\"; j_max = \"joined\"; radius = (0.5, 1.0); spin = (2.0, -0.5); cells = (%d, "
        "%d); }";
    double e[2][3];
    for (int k = 0; k < 2; k++) {
        char text[512];
        snprintf(text, sizeof text, ring, 12 << k, 48 << k);
        mesh_case_errors(text,
                         (const char *const[]){"fv.integrator=\"newton\"", "fv.steady=true",
                                               "initial.field=\"couette\"",
                                               "fv.hole=((-0.2,0.65),(0.2,0.9))", NULL},
                         1.0, e[k]);
    }
    print_message("steady ring: u %.2e %.2e p %.2e %.2e\n", e[0][0], e[1][0], e[0][1], e[1][1]);
    assert_true(log2(e[0][0] / e[1][0]) > 3.5 && e[1][0] < 2e-4);
}

TEST(ranks_agree)
{
    char text[1024];
    snprintf(text, sizeof text, waving, 32, 32);
    const char *const exact[] = {"fv.tol_pressure=1e-11", "fv.tol_viscous=1e-11", HOLE, NULL};
    assert_true(mesh_case_ranks_apart(text, exact) < 1e-8);
}

TEST(a_box_without_cells_is_a_fault)
{
    struct mesh_case c;
    char text[1024];
    snprintf(text, sizeof text, waving, 16, 16);
    mesh_case_read(&c, MPI_COMM_WORLD, text,
                   (const char *const[]){"fv.hole=((0.3,0.3),(0.32,0.32))", NULL});
    assert_true(mesh_case_refused(&c, "no cell of the blocks"));
}
