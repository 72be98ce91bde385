/* test_fv_orders.c - errors and orders of whole runs against exact solutions: Taylor-Green, two
 * waves that are carried along, a hole of forced cells, closed sides, three dimensions, bdf2 in
 * time. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "fv_case.h"

#define TWO_MODES "initial.field=\"two_modes\"", "initial.velocity=(0.5,0.25)"

/* Errors at 32 and 64 cells: within the limits, and the order between them. */
static void errors_fall(const char *const *common, const char *more, double t, double most_32,
                        double most_64, double order)
{
    const double e32 = fv_case_error_at(SANITIZED ? 16 : 32, common, more, t);
    if (SANITIZED) {
        assert_true(e32 < 0.1);
        return;
    }
    const double e64 = fv_case_error_at(64, common, more, t);
    print_message("%s: %.3g at 32, %.3g at 64, order %.2f\n", more ? more : "plain", e32, e64,
                  fv_case_order(e32, e64));
    assert_true(e32 <= most_32);
    assert_true(e64 <= most_64);
    assert_true(fv_case_order(e32, e64) >= order);
}

/* At CFL 1, as the case has it. The default of tol_viscous falls with the cells, or its error would
 * stay where that of the cells falls (from 64 to 128 by 2.5 orders, and not at all in vorticity).
 */
TEST(taylor_green_converges)
{
    static const char *const step[] = {"fv.cfl=1", NULL};
    const double e16 = fv_case_error_at(16, step, NULL, 1.0),
                 e32 = fv_case_error_at(32, step, NULL, 1.0);
    print_message("16: %.3g, order to 32 %.2f\n", e16, fv_case_order(e16, e32));
    assert_true(fv_case_order(e16, e32) >= 1.9);
    if (SANITIZED)
        return;
    errors_fall(step, NULL, 1.0, 3e-5, 2.5e-6, 3.5);
    const double e64 = fv_case_error_at(64, step, NULL, 1.0),
                 e128 = fv_case_error_at(128, step, NULL, 1.0);
    print_message("order from 64 to 128: %.2f\n", fv_case_order(e64, e128));
    assert_true(fv_case_order(e64, e128) >= 3.0); /* that of time */
}

TEST(carried_waves_converge)
{
    errors_fall((const char *const[]){TWO_MODES, NULL}, NULL, 1.0, 5e-3, 3.5e-4, 3.5);
}

TEST(hole_keeps_the_order)
{
    errors_fall((const char *const[]){TWO_MODES, NULL}, "fv.hole=((0.3125,0.3125),(0.6875,0.6875))",
                1.0, 5e-3, 3.5e-4, 3.5);
}

/* One, two and three free cells between a hole and the sides: continued by lower polynomials. */
TEST(narrow_gaps_are_stable)
{
    static const char *const holes[] = {"fv.hole=((0.03,0.03),(0.97,0.97))",
                                        "fv.hole=((0.06,0.06),(0.94,0.94))",
                                        "fv.hole=((0.09,0.09),(0.91,0.91))"};
    for (int k = 0; k < 3; k++) {
        const double e = fv_case_error(
            (const char *const[]){TWO_MODES, holes[k], "domain.periodic=(false,false)", NULL}, 1.0);
        print_message("%s: %.3g\n", holes[k], e);
        assert_true(e < 0.1);
    }
}

/* Cells deep in a hole hold no flow: they must not set the step of one that decays. */
TEST(hole_does_not_limit_the_step)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){"fv.hole=((0.125,0.125),(0.875,0.875))", NULL});
    fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 100000, 1.0));
    assert_true(c.s->max.u[0] < 0.8 && c.s->max.u[1] < 0.8);
    fv_free(&c.s);
}

/* At half the largest step: at CFL 1 the error of time lowers the order to 3.4 (fv/README.md). */
TEST(closed_sides_keep_the_order)
{
    const char *const common[] = {TWO_MODES, "fv.cfl=0.5", NULL};
    errors_fall(common, "domain.periodic=(false,false)", 1.0, 5e-3, 3.5e-4, 3.5);
    errors_fall(common, "domain.periodic=(true,false)", 1.0, 5e-3, 3.5e-4, 3.5);
}

/* Against the same cells with a much smaller step, so that only time differs. */
TEST(bdf2_has_order_two)
{
    static const char *const cfl[3] = {"fv.cfl=0.4", "fv.cfl=0.2", "fv.cfl=0.025"};
    struct fv_case c[3];
    for (int k = 0; k < 3; k++) {
        fv_case_set(c + k, MPI_COMM_WORLD,
                    (const char *const[]){TWO_MODES, "fv.cells=(32,32)", "fv.integrator=\"bdf2\"",
                                          "fv.tol_pressure=1e-6", "fv.tol_viscous=1e-8", cfl[k],
                                          NULL});
        fv_case_start(c + k, NULL);
        assert_true(fv_case_run(c + k, 100000, 0.5));
    }
    double e[2] = {0.0, 0.0};
    for (int k = 0; k < 2; k++)
        for (int a = 0; a < 2; a++)
            BLOCK_ROWS (&c[k].s->b, 0, at, n)
                for (int64_t i = at; i < at + n; i++)
                    e[k] += pow(c[k].s->u[a][i] - c[2].s->u[a][i], 2);
    const double order = 0.5 * fv_case_order(e[0], e[1]);
    print_message("order %.2f\n", order);
    assert_true(order >= 1.8 && order < 2.5);
    for (int k = 0; k < 3; k++)
        fv_free(&c[k].s);
}

/* One layer after the other equals the 2D run; multigrid takes another path, so solves are tight.
 */
TEST(plane_flow_is_the_same_in_3d)
{
    static const char *const cells[2] = {"fv.cells=(24,24)", "fv.cells=(24,24,6)"};
    static const char *const dims[2] = {"domain.dim=2", "domain.dim=3"};
    struct fv_case c[2];
    double most = 0.0;
    for (int k = 0; k < 2; k++) {
        fv_case_set(c + k, MPI_COMM_WORLD,
                    (const char *const[]){TWO_MODES, cells[k], dims[k], "fv.integrator=\"bdf2\"",
                                          "fv.cfl=0.5", "fv.tol_pressure=1e-13",
                                          "fv.tol_viscous=1e-13", NULL});
        fv_case_start(c + k, NULL);
        assert_true(fv_case_run(c + k, 8, 1.0));
    }
    const struct block *b = &c[1].s->b;
    BLOCK_CELLS (b, i, j, k, at) {
        const int64_t flat = block_at(&c[0].s->b, i, j, 0);
        for (int a = 0; a < 2; a++)
            most = fmax(most, fabs(c[1].s->u[a][at] - c[0].s->u[a][flat]));
        most = fmax(most, fabs(c[1].s->u[2][at]));
    }
    print_message("largest difference %.3g m/s\n", most);
    assert_close(most, 0.0, 1e-10);
    for (int k = 0; k < 2; k++)
        fv_free(&c[k].s);
}

/* rk3's first two projections are one cycle of multigrid, which differs in 3D: the error must not.
 */
TEST(rk3_is_as_good_in_3d)
{
    const double flat =
        fv_case_error((const char *const[]){TWO_MODES, "fv.cells=(32,32)", NULL}, 0.25);
    const double solid = fv_case_error(
        (const char *const[]){TWO_MODES, "domain.dim=3", "fv.cells=(32,32,4)", NULL}, 0.25);
    print_message("2D %.3g, 3D %.3g\n", flat, solid);
    assert_true(fabs(solid - flat) < 0.1 * flat);
}
