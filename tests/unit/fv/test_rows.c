/* test_rows.c - rows of unequal height: their heights, weights on polynomials, orders and exact
 * flows over them. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/grid/rows.h"
#include "fv_bc_case.h"

TEST(heights_fill_the_domain)
{
    double h[60], sum = 0.0, above = 0.0, most = 1.0;
    const double ratio = rows_heights(60, 32, 1.65, 2.5, h);
    for (int i = 0; i < 60; i++) {
        sum += h[i];
        above += i >= 28 ? h[i] : 0.0;
        most = i > 0 ? fmax(most, h[i - 1] / h[i]) : 1.0;
        assert_true(i == 0 || h[i] <= h[i - 1] * (1.0 + 1e-12));
        assert_true(i >= ROWS_BOTTOM || fabs(h[i] / h[0] - 1.0) < 1e-12);
    }
    assert_close(sum, 2.5, 1e-12);
    assert_close(above, 0.85, 1e-12);
    assert_close(ratio, most, 1e-12);
    assert_true(ratio > 1.0 && ratio < 1.3);
    assert_true(isnan(rows_heights(20, 13, 1.65, 2.5, h))); /* too few left */
    assert_true(isnan(rows_heights(60, 10, 0.5, 2.5, h)));  /* they would be lower there */
    assert_true(isnan(rows_heights(60, 32, 2.5, 2.5, h)));  /* nothing above */
    assert_true(isnan(rows_heights(60, 32, -0.1, 2.5, h)));
}

/* Of y^n at y: the integral (-1), itself (0), the derivative (1). */
static double power(int n, int derivative, double y)
{
    return derivative == -1  ? pow(y, n + 1) / (n + 1)
           : derivative == 0 ? pow(y, n)
           : n == 0          ? 0.0
                             : n * pow(y, n - 1);
}

TEST(weights_are_exact_for_cubics)
{
    struct block b;
    double h[40], most[4] = {0.0};
    block_create(&b, MPI_COMM_SELF, 2, (const int[]){4, 40, 1}, (const double[]){0.0, -0.5, 0.0},
                 (const double[]){1.0, 2.0, 1.0}, (const bool[]){true, false, false});
    assert_true(rows_heights(40, 20, 1.4, 2.0, h) > 1.0);
    block_set_rows(&b, 20, h);
    const struct rows *r = b.rows;
    for (int n = 0; n <= 3; n++)
        for (int j = 0; j < 40; j++) {
            double q[5], value = 0.0, slope = 0.0, gradient = 0.0, laplace = 0.0;
            const double low = r->y[j] - 0.5 * r->h[j], high = low + r->h[j];
            for (int m = -2; m <= 2; m++) {
                const double y0 = r->y[j + m] - 0.5 * r->h[j + m], y1 = y0 + r->h[j + m];
                q[m + 2] = (power(n, -1, y1) - power(n, -1, y0)) / r->h[j + m];
            }
            for (int m = 0; m < 5; m++) {
                value += m < 4 ? r->face[j][m] * q[m] : 0.0;
                slope += m < 4 ? r->slope[j][m] * q[m] : 0.0;
                gradient += r->gradient[j][m] * q[m];
                laplace += r->laplace[j][m] * q[m];
            }
            most[0] = fmax(most[0], fabs(value - power(n, 0, low)));
            most[1] = fmax(most[1], fabs(slope - power(n, 1, low)));
            most[2] =
                fmax(most[2], fabs(gradient - (power(n, 0, high) - power(n, 0, low)) / r->h[j]));
            most[3] =
                fmax(most[3], fabs(laplace - (power(n, 1, high) - power(n, 1, low)) / r->h[j]));
        }
    print_message("%.3g %.3g %.3g %.3g\n", most[0], most[1], most[2], most[3]);
    assert_true(most[0] < 1e-13 && most[1] < 1e-11 && most[2] < 1e-11 && most[3] < 1e-9);
    assert_close(r->face[30][1], 7.0 / 12.0, 1e-12); /* even rows: the plain ones */
    assert_close(r->laplace[30][2] * b.h[1] * b.h[1], -2.5, 1e-10);
    block_free(&b);
}

/* What goes on beyond an edge upwards or downwards is exact for cubics, and evenly for 1 and y^2
 * about the edge. */
TEST(what_goes_on_is_exact_too)
{
    const double heights[9] = {1.9, 1.7, 1.6, 1.4, 1.3, 1.1, 1.0, 1.0, 0.9}, *h = heights + 4;
    double edge[10] = {0.0}, most[2] = {0.0, 0.0};
    for (int j = 0; j < 9; j++)
        edge[j + 1] = edge[j] + heights[j];
    for (int way = -1; way <= 1; way += 2)
        for (int depth = 1; depth <= 2; depth++)
            for (int n = 0; n <= 3; n++) {
                const double zero = way > 0 ? edge[5] : edge[4];
                double q[9], w[4], go = 0.0, evenly = 0.0;
                for (int j = 0; j < 9; j++)
                    q[j] = (power(n, -1, edge[j + 1] - zero) - power(n, -1, edge[j] - zero)) /
                           heights[j];
                rows_beyond(h, way, 4, depth, w);
                for (int m = 0; m < 4; m++)
                    go += w[m] * q[4 - way * m];
                rows_mirror(h, way, 2, depth, w);
                for (int m = 0; m < 2; m++)
                    evenly += w[m] * q[4 - way * m];
                most[0] = fmax(most[0], fabs(go - q[4 + way * depth]));
                most[1] = fmax(most[1], n % 2 ? 0.0 : fabs(evenly - q[4 + way * depth]));
            }
    assert_true(most[0] < 1e-12 && most[1] < 1e-12);
}

#define END (SANITIZED ? 0.05 : 1.0) /* s */

TEST(order_is_kept)
{
    static const char *const common[] = {"initial.field=\"two_modes\"",
                                         "initial.velocity=(0.5,0.25)",
                                         "domain.periodic=(true,false)", "fv.cfl=0.5", NULL};
    const double e32 = fv_case_error_at(32, common, "fv.graded=(0.6,16)", END),
                 e64 = fv_case_error_at(64, common, "fv.graded=(0.6,32)", END);
    print_message("32: %.3g, 64: %.3g, order %.2f\n", e32, e64, fv_case_order(e32, e64));
    assert_true(SANITIZED || (e64 < 6e-4 && fv_case_order(e32, e64) >= 3.4));
}

/* A hole whose outline lies in growing rows, and Newton's method around it. */
TEST(a_hole_keeps_the_order)
{
    static const char *const common[] = {"initial.field=\"two_modes\"",
                                         "initial.velocity=(0.5,0.25)",
                                         "domain.periodic=(true,false)",
                                         "fv.hole=((0.3,0.2),(0.7,0.5))",
                                         "fv.cfl=0.5",
                                         NULL};
    const double e32 = fv_case_error_at(32, common, "fv.graded=(0.6,16)", END),
                 e64 = fv_case_error_at(64, common, "fv.graded=(0.6,32)", END);
    print_message("32: %.3g, 64: %.3g, order %.2f\n", e32, e64, fv_case_order(e32, e64));
    assert_true(SANITIZED || (e64 < 6e-4 && fv_case_order(e32, e64) >= 2.9));
}

TEST(slip_walls_keep_the_order)
{
    const double e24 = box_slip_error(24, "fv.graded=(0.6,12)"),
                 e48 = box_slip_error(48, "fv.graded=(0.6,24)");
    print_message("24: %.3g, 48: %.3g, order %.2f\n", e24, e48, fv_case_order(e24, e48));
    assert_true(e48 < 5e-5 && fv_case_order(e24, e48) >= 3.3);
}

/* Between two walls: a parabola, so exact, and the walls carry what drives it. */
TEST(channel_is_exact)
{
    struct fv_case c;
    double row[FV_CASE_ROW];
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){"initial.field=\"poiseuille\"",
                                      "domain.periodic=(true,false)", "fluid.nu=0.1",
                                      "fv.cells=(4,24)", "fv.graded=(0.6,12)", NULL});
    c.run.scene.fluid.gravity[0] = 0.8;
    wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 0.0);
    fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 100000, 40.0));
    VALUES_OF(fv_row, c.s, row);
    assert_close(row[3], 0.0, 1e-11);
    assert_close(row[4], 0.8, 1e-11);
    fv_free(&c.s);
}

/* A duct from a parabolic inlet to an outlet of either kind, by both projected integrators: the
 * parabola, and the walls carry what drives it. */
TEST(duct_is_exact)
{
    static const char *const integrators[] = {"fv.integrator=\"rk3\"", "fv.integrator=\"bdf2\""};
    for (int k = 0; k < 4; k++) {
        struct fv_case c;
        double row[FV_CASE_ROW];
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){CLOSED, "initial.field=\"rest\"", "fluid.nu=0.1",
                                          "fv.cells=(8,24)", "fv.graded=(0.6,12)",
                                          integrators[k % 2], NULL});
        wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0)->profile = PROFILE_PARABOLIC;
        wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0)->carried = k >= 2;
        wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
        wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 0.0);
        fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 100000, 8.0));
        VALUES_OF(fv_row, c.s, row);
        print_message("%s, %s: force %.6g N, wanted 0.8\n", integrators[k % 2],
                      k >= 2 ? "carried" : "pressure", row[3]);
        assert_close(row[3], 0.8, 1e-5);
        fv_free(&c.s);
    }
}

/* A lid over graded rows: its energy is that over as fine even ones. */
static double lid_energy(const char *cells, const char *graded)
{
    struct fv_case c;
    double row[FV_CASE_ROW];
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){CLOSED, "initial.field=\"rest\"", "fluid.nu=0.01", cells,
                                      graded, NULL});
    wall_add(&c, SIDE_X_MIN, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_X_MAX, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 1.0);
    fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 100000, 2.0));
    VALUES_OF(fv_row, c.s, row);
    fv_free(&c.s);
    return row[0];
}

TEST(cavity_is_the_same)
{
    const double fine = lid_energy("fv.cells=(48,64)", "fv.graded=(0,0)"),
                 graded = lid_energy("fv.cells=(48,44)", "fv.graded=(0.5,32)"),
                 even = lid_energy("fv.cells=(48,44)", "fv.graded=(0,0)");
    print_message("energy %.6g, %.6g on graded, %.6g on even rows\n", fine, graded, even);
    assert_true(fabs(graded / fine - 1.0) < 5e-4);
}

/* u = -exp(-(y - 0.3)^2/b^2), v = sin(2 pi x) cos(y - 0.5), both times cos(z - 0.5) if there are
 * cells along z, as averages: error of the extrema on the centre lines, which are 1. even: layers
 * of that height; 0: none. */
static double extrema_error(int cells, int even, int thick)
{
    const double b = 0.15, two_pi = 2.0 * M_PI;
    struct fv_case c;
    double error = NAN, x[3], h[3];
    char size[48], graded[48];
    snprintf(size, sizeof size, "fv.cells=(%d,%d,%d)", cells, cells, thick ? thick : 1);
    snprintf(graded, sizeof graded, even ? "fv.graded=(0.6,%d)" : "fv.graded=(0,0)", even);
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){CLOSED, "initial.field=\"rest\"", size, graded,
                                      thick ? "domain.dim=3" : "domain.dim=2",
                                      "fv.extrema=(-1,1,-1)", NULL});
    for (int k = SIDE_X_MIN; k <= (thick ? SIDE_Z_MAX : SIDE_Y_MAX); k++)
        wall_add(&c, (enum scene_side)k, WALL_NO_SLIP, 0.0);
    struct fv *s = fv_case_start(&c, NULL);
    assert_true((s->b.rows != NULL) == (even > 0));
    BLOCK_CELLS (&s->b, i, j, k, at) {
        block_cell(&s->b, i, j, k, x, h);
        const double low = x[1] - 0.5 * h[1], up = x[1] + 0.5 * h[1], left = x[0] - 0.5 * h[0];
        s->u[0][at] = -0.5 * b * sqrt(M_PI) * (erf((up - 0.3) / b) - erf((low - 0.3) / b)) / h[1];
        s->u[1][at] = (cos(two_pi * left) - cos(two_pi * (left + h[0]))) / (two_pi * h[0]) *
                      (sin(up - 0.5) - sin(low - 0.5)) / h[1];
        for (int a = 0; a < 2 && thick; a++)
            s->u[a][at] *= (sin(x[2] + 0.5 * h[2] - 0.5) - sin(x[2] - 0.5 * h[2] - 0.5)) / h[2];
    }
    c.run.summary = summary_create();
    fv_summarise_extrema(s);
    assert_true(summary_find(c.run.summary, "error.extrema", &error));
    DROP(c.run.summary);
    fv_free(&c.s);
    return error;
}

/* As the scheme is: fourth order; in 3D between two cells along z, or in the middle of one, too. */
TEST(extrema_are_of_the_order_of_the_scheme)
{
    const double coarse = extrema_error(32, 16, 0), fine = extrema_error(64, 32, 0);
    print_message("extrema: %.3g, %.3g\n", coarse, fine);
    assert_true(fv_case_order(coarse, fine) > 3.5 && fine < 1e-4);
    for (int k = 0; k < 2; k++) {
        const double deep = extrema_error(32, k ? 16 : 0, k ? 9 : 8);
        print_message("in 3D: %.3g\n", deep);
        assert_close(deep, coarse, 1e-4);
    }
}
