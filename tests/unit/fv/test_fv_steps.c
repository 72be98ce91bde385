/* test_fv_steps.c - symmetry of the viscous operator; uniform flow stays; divergence after a step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "fv_case.h"

#include "../../../fv/operators/operators.h"

static void fill_random(const struct fv *s, double *q)
{
    BLOCK_ROWS (&s->b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            q[i] = (double)rand() / RAND_MAX - 0.5;
    if (s->forcing)
        forcing_zero(s->forcing, q);
    block_halo(&s->b, 1, &q);
}

static double product(const struct fv *s, const double *x, const double *y)
{
    double sum = 0.0;
    BLOCK_ROWS (&s->b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            sum += x[i] * y[i];
    return sum;
}

/* x.Ly = y.Lx and x.Lx < 0, which conjugate gradients need; also next to forced cells. */
TEST(viscous_operator_is_symmetric)
{
    static const char *const cases[3][6] = {
        {"fv.cells=(16,12)", "domain.max=(1.0,1.3)", NULL},
        {"domain.dim=3", "fv.cells=(12,10,8)", "domain.max=(1.0,1.3,0.5)", NULL},
        {"fv.cells=(32,32)", "fv.hole=((0.3125,0.3125),(0.6875,0.6875))", NULL}};
    for (int k = 0; k < 3; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_WORLD, cases[k]);
        struct fv *s = fv_case_start(&c, NULL);
        fill_random(s, s->u[0]);
        fill_random(s, s->u[1]);
        viscous_apply(s, s->u[0], s->rhs[0]);
        viscous_apply(s, s->u[1], s->rhs[1]);
        const double xx = product(s, s->u[0], s->rhs[0]);
        assert_true(xx < 0.0);
        assert_close(product(s, s->u[1], s->rhs[0]), product(s, s->u[0], s->rhs[1]), -1e-12 * xx);
        fv_free(&c.s);
    }
}

TEST(uniform_flow_stays)
{
    static const char *const dims[] = {"domain.dim=2", "domain.dim=3"};
    static const char *const ways[] = {"fv.integrator=\"rk3\"", "fv.integrator=\"bdf2\""};
    static const double wanted_u[3] = {0.7, -0.4, 0.3};
    for (int q = 0; q < 4; q++) {
        struct fv_case c;
        double most = 0.0;
        fv_case_set(&c, MPI_COMM_WORLD,
                    (const char *const[]){
                        dims[q / 2], ways[q % 2], "fv.cells=(16,12,8)", "domain.max=(1.0,1.3,0.5)",
                        "fv.cfl=0.6", "initial.field=\"uniform\"",
                        q < 2 ? "initial.velocity=(0.7,-0.4)" : "initial.velocity=(0.7,-0.4,0.3)",
                        NULL});
        fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 10, 100.0));
        for (int a = 0; a < c.s->b.dim; a++)
            BLOCK_ROWS (&c.s->b, 0, at, n)
                for (int64_t i = at; i < at + n; i++)
                    most = fmax(most, fabs(c.s->u[a][i] - wanted_u[a]));
        assert_close(most, 0.0, 1e-12);
        fv_free(&c.s);
    }
}

/* From a rough start; the divergence it had and the one that a step leaves, both times h. */
TEST(step_leaves_no_divergence)
{
    static const char *const cases[3][6] = {
        {"fv.cells=(32,32)", "fv.tol_pressure=1e-10", NULL},
        {"fv.cells=(32,32)", "fv.tol_pressure=1e-10", "fv.hole=((0.3125,0.3125),(0.6875,0.6875))",
         NULL},
        {"fv.cells=(16,16,8)", "fv.tol_pressure=1e-10", "domain.dim=3", NULL}};
    for (int k = 0; k < 3; k++) {
        struct fv_case c;
        double row[FV_CASE_ROW];
        fv_case_set(&c, MPI_COMM_WORLD, cases[k]);
        struct fv *s = fv_case_start(&c, NULL);
        for (int a = 0; a < s->b.dim; a++) {
            BLOCK_ROWS (&s->b, 0, at, n)
                for (int64_t i = at; i < at + n; i++)
                    s->u[a][i] += 0.1 * ((double)rand() / RAND_MAX - 0.5);
        }
        block_halo(&s->b, s->b.dim, s->u);
        convection_face_velocities(s, s->u, s->U);
        VALUES_OF(fv_row, s, row);
        assert_true(row[2] > 0.02); /* the test tests something */
        assert_true(fv_case_run(&c, 1, 100.0));
        VALUES_OF(fv_row, s, row);
        assert_close(row[2], 0.0, 1e-10);
        fv_free(&c.s);
    }
}

/* Energy only falls when the step changes by ten and back. */
TEST(steps_may_change_tenfold)
{
    static const char *const ways[] = {"fv.integrator=\"rk3\"", "fv.integrator=\"bdf2\""};
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        double row[FV_CASE_ROW], last;
        fv_case_set(
            &c, MPI_COMM_WORLD,
            (const char *const[]){"initial.field=\"two_modes\"", ways[k], "fv.cfl=0.5", NULL});
        struct fv *s = fv_case_start(&c, NULL);
        VALUES_OF(fv_row, s, row);
        last = row[0];
        for (int n = 0; n < 40; n++) {
            s->prm.cfl *= n % 4 == 1 ? 0.1 : n % 4 == 3 ? 10.0 : 1.0;
            assert_true(fv_case_run(&c, 1, 1000.0));
            VALUES_OF(fv_row, s, row);
            assert_true(row[0] < last);
            last = row[0];
        }
        assert_true(row[3] < 0.1);
        fv_free(&c.s);
    }
}
