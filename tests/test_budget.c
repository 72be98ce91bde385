/* test_budget.c - what the operators do to the momentum of the flow is what it does to the walls;
 * the divergence of the fluxes is what the solver leaves. SPDX-License-Identifier: BSD-3-Clause */
#include "test.h"

#include "../fv/boundary/mesh_bc.h"
#include "../fv/operators/mesh_ops.h"
#include "../fv/time/stages.h"
#include "fv_bc_case.h"
#include "mesh_case.h"

/* sums[a]: rho times the volume integral of -N + nu Lap u - grad p along a; sums[3]: the largest of
 * the three alone. */
static void rates(struct fv *s, double sums[4])
{
    const double rho = s->run->scene.fluid.rho;
    memset(sums, 0, 4 * sizeof(double));
    memcpy(s->p_before, s->p, (size_t)s->size * sizeof(double));
    s->stages->fill_velocity(s);
    s->stages->convection(s, s->N);
    if (!s->m)
        block_halo(&s->b, 1, &s->p);
    else {
        mesh_fill(s->m, 1, &s->p);
        mesh_bc_pressure(s, s->p);
        mesh_gradient(s, s->p, s->step_p);
    }
    for (int a = 0; a < s->dim; a++) {
        double part[3] = {0.0, 0.0, 0.0};
        s->stages->viscous(s, a, s->rhs[a]);
        if (!s->m)
            gradient(s, s->p, a, CONTINUE_CUBIC, s->step_p[a]);
        FLOW_ROWS(s, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const double V = s->m ? s->free[i] * s->m->V[i] : s->b.h[0] * s->b.h[1] * s->b.h[2];
            part[0] -= rho * V * s->N[a][i];
            part[1] += rho * V * s->rhs[a][i];
            part[2] -= rho * V * s->step_p[a][i];
        }
        MPI_Allreduce(MPI_IN_PLACE, part, 3, MPI_DOUBLE, MPI_SUM, s->comm);
        sums[a] = part[0] + part[1] + part[2];
        for (int k = 0; k < 3; k++)
            sums[3] = fmax(sums[3], fabs(part[k]));
    }
}

static void force_of(struct fv *s, double *force)
{
    double of[MESH_BLOCKS_MAX][4];
    if (!s->m) {
        fv_wall_force(s, force);
        return;
    }
    mesh_bc_force(s, of);
    memset(force, 0, 3 * sizeof(double));
    for (int k = 0; k < s->m->nblocks; k++)
        for (int a = 0; a < s->dim; a++)
            force[a] += of[k][a];
}

/* Vortices in a duct: along it the walls take what the flow loses; in a box both ways. Its fluxes
 * have the divergence that the solver was allowed. */
static void walls_take_what_the_flow_loses(void **state)
{
    (void)state;
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

    struct mesh_case m;
    /* one rank: at a cut the slip of the projection is known one place beyond it, NOTES.md */
    s = mesh_case_start(&m, MPI_COMM_SELF,
                        "{ name = \"a\"; cells = (32, 32); max = (1.0, 1.0); i_min = \"wall\"; "
                        "i_max = \"wall\"; j_min = \"wall\"; j_max = \"wall\"; }",
                        (const char *const[]){"fv.tol_pressure=1e-11", NULL});
    assert_true(mesh_case_run(s, 8, 100.0));
    rates(s, sums);
    force_of(s, force);
    print_message("box, a block: %g %g of %g\n", sums[0] + force[0], sums[1] + force[1], sums[3]);
    for (int a = 0; a < 2; a++)
        assert_true(fabs(force[a]) > 1e-5 && fabs(sums[a] + force[a]) < 1e-10 * sums[3]);
    double div = 0.0;
    mesh_divergence(s, s->U, s->flux);
    FLOW_ROWS(s, at, n)
    for (int64_t i = at; i < at + n; i++)
        div = fmax(div, fabs(s->flux[i]) * 32.0);
    MPI_Allreduce(MPI_IN_PLACE, &div, 1, MPI_DOUBLE, MPI_MAX, s->comm);
    print_message("divergence %g of the speed over a cell\n", div);
    assert_true(div < 1e-11);
    mesh_case_end(&m, &s);
}

/* Between two cylinders, from a flow that knows nothing of them. */
static void curved_walls_take_it_to_the_order_of_the_scheme(void **state)
{
    (void)state;
    double miss[2], sums[4], force[3];
    for (int k = 0; k < 2; k++) {
        struct mesh_case c;
        char text[512];
        snprintf(text, sizeof text,
                 "{ name = \"ring\"; mapping = \"annulus\"; centre = (0.1, 0.05); radius = (0.5, "
                 "1.0); cells = (%d, %d); i_min = \"wall\"; i_max = \"wall\"; j_min = \"joined\"; "
                 "j_max = \"joined\"; }",
                 12 << k, 48 << k);
        struct fv *s =
            mesh_case_start(&c, MPI_COMM_WORLD, text, (const char *const[]){"fluid.nu=0.05", NULL});
        assert_true(mesh_case_run(s, 1000, 0.3));
        rates(s, sums);
        force_of(s, force);
        miss[k] = hypot(sums[0] + force[0], sums[1] + force[1]) / sums[3];
        print_message("ring: force %g %g, missing %g of %g\n", force[0], force[1],
                      miss[k] * sums[3], sums[3]);
        mesh_case_end(&c, &s);
    }
    assert_true(miss[1] < 2e-6 && log2(miss[0] / miss[1]) > 3.0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walls_take_what_the_flow_loses),
        cmocka_unit_test(curved_walls_take_it_to_the_order_of_the_scheme)};
    MPI_Init(&argc, &argv);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    MPI_Finalize();
    return failed;
}
