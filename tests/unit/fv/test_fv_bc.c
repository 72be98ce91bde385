/* test_fv_bc.c - walls and openings: a vortex between no-slip walls against finer grids,
 * Taylor-Green between slip walls, channels, a duct, forces, rest under gravity.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/operators/flow_measures.h"
#include "../../../fv/operators/operators.h"
#include "fv_bc_case.h"

TEST(no_slip_walls_keep_the_order)
{
    static const double cfl[2] = {0.5, 1.0};
    for (int k = 0; k < 2; k++) {
        struct box_flow f[3];
        double d[2][3], order[3];
        for (int m = 0; m < 3; m++)
            box_run(f + m, (SANITIZED ? 8 : 32) << m, cfl[k], 0.25);
        for (int m = 0; m < 2; m++)
            box_difference(f + m, f + m + 1, d[m]);
        for (int q = 0; q < 3; q++)
            order[q] = fv_case_order(d[0][q], d[1][q]);
        print_message("CFL %g: velocity %.3g order %.2f, largest %.3g %.2f, pressure %.3g %.2f\n",
                      cfl[k], d[0][0], order[0], d[0][1], order[1], d[0][2], order[2]);
        assert_true(SANITIZED || d[0][0] < 4e-4);
        assert_true(SANITIZED || (order[0] >= 3.5 && order[1] >= 2.8 && order[2] >= 1.9));
        for (int m = 0; m < 3; m++)
            box_free(f + m);
    }
}

TEST(slip_walls_keep_the_order)
{
    const double e16 = box_slip_error(16, "fv.graded=(0,0)"),
                 e32 = box_slip_error(32, "fv.graded=(0,0)");
    print_message("16: %.3g, 32: %.3g, order %.2f\n", e16, e32, fv_case_order(e16, e32));
    assert_true(e32 < 3e-5 && fv_case_order(e16, e32) >= 3.5);
}

/* Steady flow between two walls: a polynomial, so exact. */
static void channel(struct fv_case *c, const char *field, double force, double lid)
{
    char name[64];
    snprintf(name, sizeof name, "initial.field=\"%s\"", field);
    fv_case_set(c, MPI_COMM_SELF,
                (const char *const[]){name, "domain.periodic=(true,false)", "fluid.nu=0.1",
                                      "fv.cells=(4,16)", NULL});
    c->run.scene.fluid.gravity[0] = force;
    wall_add(c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(c, SIDE_Y_MAX, WALL_NO_SLIP, lid);
    fv_case_start(c, NULL);
}

TEST(steady_channels_are_exact)
{
    struct fv_case c;
    double row[FV_CASE_ROW];
    channel(&c, "poiseuille", 0.8, 0.0);
    assert_true(fv_case_run(&c, 100000, 40.0));
    VALUES_OF(fv_row, c.s, row);
    assert_close(row[3], 0.0, 1e-12);
    assert_close(row[4], 0.8, 1e-12); /* the walls carry what drives the flow */
    fv_free(&c.s);
    channel(&c, "couette", 0.0, 1.0);
    assert_true(fv_case_run(&c, 100000, 40.0));
    VALUES_OF(fv_row, c.s, row);
    assert_close(row[3], 0.0, 1e-12);
    assert_close(row[4], 0.0, 1e-12);
    fv_free(&c.s);
}

/* A stream between slip walls that starts at once has no velocity across. */
TEST(slip_walls_leave_a_stream_uniform)
{
    struct fv_case c;
    double most = 0.0;
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){"initial.field=\"rest\"", CLOSED, "fv.cells=(20,16)",
                                      "fv.tol_pressure=1e-12", NULL});
    wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 5.0);
    wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
    wall_add(&c, SIDE_Y_MIN, WALL_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
    fv_case_start(&c, NULL);
    BLOCK_CELLS (&c.s->b, i, j, k, at)
        most = fmax(most, fabs(c.s->u[0][at] - 5.0));
    assert_true(most < 1e-9); /* 1.4 in the cells beside the inlet: its faces bend psi */
    assert_true(fv_case_run(&c, 5, 1e9));
    BLOCK_CELLS (&c.s->b, i, j, k, at)
        most = fmax(most, fabs(c.s->u[1][at]));
    print_message("across %.3g m/s\n", most);
    assert_true(most < 1e-9);
    fv_free(&c.s);
}

TEST(channels_start_as_they_should)
{
    struct fv_case c;
    double row[FV_CASE_ROW];
    channel(&c, "poiseuille", 0.8, 0.0);
    c.s->prm.cfl = 0.1;
    assert_true(fv_case_run(&c, 100000, 1.0));
    VALUES_OF(fv_row, c.s, row);
    print_message("poiseuille at t = 1: %.3g\n", row[3]);
    assert_true(row[3] < 1e-4);
    fv_free(&c.s);
}

/* A parabola flows in and out; or two pressures drive it. Viscous, so steady at t = 20. */
TEST(ducts_are_exact)
{
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){CLOSED, "initial.field=\"rest\"", "fluid.nu=0.2",
                                          "fluid.rho=2.0", "fv.cells=(16,16)", NULL});
        wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
        wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 0.0);
        wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
        if (k == 0)
            wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0)->profile = PROFILE_PARABOLIC;
        else
            wall_add(&c, SIDE_X_MIN, WALL_OUTFLOW, 0.0)->pressure = 3.2; /* 8 rho nu U/L^2 L */
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 100000, 20.0));
        const double most = parabola_error(s);
        print_message("%s: %.3g\n", k ? "pressures" : "inflow", most);
        assert_true(most < 1e-8);
        fv_free(&c.s);
    }
}

/* From rest on cells that see nothing of the boundary layer yet: what a lid drags does not depend
 * on its side, to the tolerance of the projections, and is what Stokes' layer holds, 2 sqrt(nu
 * t/pi) a metre and lid speed, to a quarter: it piles up before the end of the lid. */
TEST(lids_drag_alike_on_all_sides)
{
    double speed[4];
    for (int k = 0; k < 4; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){CLOSED, "initial.field=\"rest\"", "fluid.nu=1e-4",
                                          "fv.cells=(16,16)", NULL});
        fv_case_close(&c, WALL_NO_SLIP);
        c.run.scene.walls[k].velocity[1 - k / 2] = 1.0;
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 20, 1.0));
        speed[k] = s->max.u[1 - k / 2];
        print_message("lid on side %d: %.4g m/s along it\n", k, speed[k]);
        assert_close(speed[k], speed[0], 0.02 * speed[0]);
        assert_close(speed[k] / (2.0 * sqrt(1e-4 / M_PI) * 16.0), 1.0, 0.25);
        fv_free(&c.s);
    }
}

TEST(rest_stays_under_gravity)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_SELF, (const char *const[]){CLOSED, "initial.field=\"rest\"", NULL});
    c.run.scene.fluid.gravity[1] = -9.81;
    for (int k = SIDE_X_MIN; k <= SIDE_Y_MAX; k++)
        wall_add(&c, (enum scene_side)k, WALL_NO_SLIP, 0.0);
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 20, 1.0));
    assert_close(s->max.u[0] + s->max.u[1], 0.0, 1e-300);
    assert_close(fv_still_pressure(s, (const double[]){0.5, 0.25, 0.0}), 0.75 * 9.81, 1e-12);
    double force[4];
    flow_forces(s, NULL, force);
    assert_close(force[1], -9.81, 1e-12); /* weight of the water */
    fv_free(&c.s);
}

/* No start kicks it, though p is not 0. */
TEST(rest_stays_between_equal_pressures)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_SELF, (const char *const[]){CLOSED, "initial.field=\"rest\"", NULL});
    for (int k = SIDE_X_MIN; k <= SIDE_X_MAX; k++)
        wall_add(&c, (enum scene_side)k, WALL_OUTFLOW, 0.0)->pressure = 1e4;
    for (int k = SIDE_Y_MIN; k <= SIDE_Y_MAX; k++)
        wall_add(&c, (enum scene_side)k, WALL_NO_SLIP, 0.0);
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 200, 100.0));
    assert_close(fmax(s->max.u[0], s->max.u[1]), 0.0, 1e-9);
    fv_free(&c.s);
}

/* Kinetic energy of a duct at t = 0.5 whose stream starts at once, past a no-slip floor. */
static double energy_of_duct(double pressure)
{
    struct fv_case c;
    double sum = 0.0;
    fv_case_set(&c, MPI_COMM_SELF, (const char *const[]){CLOSED, "initial.field=\"rest\"", NULL});
    wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0);
    wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0)->pressure = pressure;
    wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 1000, 0.5));
    BLOCK_ROWS (&s->b, 0, at, n)
        for (int64_t i = at; i < at + n; i++)
            sum += s->u[0][i] * s->u[0][i] + s->u[1][i] * s->u[1][i];
    fv_free(&c.s);
    return sum;
}

TEST(the_level_of_pressure_moves_nothing)
{
    const double E = energy_of_duct(0.0);
    assert_close(energy_of_duct(1e-6) / E, 1.0, 1e-6); /* as well as psi is solved for */
    assert_close(energy_of_duct(1e3) / E, 1.0, 1e-6);
}

/* A vortex of Gaussian stream function in a uniform flow, averages and fluxes. */
static void vortex_fill(struct fv *s, double x0, double y0)
{
    const struct block *b = &s->b;
    const double h = b->h[0], r = 0.1, A = 0.25 * r * sqrt(2.0) * exp(0.5); /* 0.25 m/s at most */
    for (int j = -1; j <= b->n[1]; j++)
        for (int i = -1; i <= b->n[0]; i++) {
            const int64_t c = block_at(b, i, j, 0);
            const double x = (i * h - x0) / r, y = (j * h - y0) / r, d = h / r;
            const double gx = exp(-x * x), gy = exp(-y * y), Gx = exp(-(x + d) * (x + d)),
                         Gy = exp(-(y + d) * (y + d)), k = 0.5 * sqrt(M_PI);
            const double X = k * (erf(x + d) - erf(x)) / d, Y = k * (erf(y + d) - erf(y)) / d;
            s->u[0][c] = 1.0 + A * X * (Gy - gy) / h;
            s->u[1][c] = -A * Y * (Gx - gx) / h;
            s->U[0][c] = 1.0 + A * gx * (Gy - gy) / h;
            s->U[1][c] = -A * gy * (Gx - gx) / h;
        }
    fv_start(s);
}

/* What is left of the vortex's velocity, relative to its largest, when it should have gone. */
static double left_behind(const char *integrator, double cfl, bool carried)
{
    struct fv_case c;
    double most = 0.0, kept;
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){"domain.periodic=(false,true)", "initial.field=\"uniform\"",
                                      "initial.velocity=(1,0)", "fluid.nu=1e-4", "fv.cells=(48,48)",
                                      integrator, NULL});
    wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0);
    wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0)->carried = carried;
    struct fv *s = fv_case_start(&c, NULL);
    s->prm.cfl = cfl;
    vortex_fill(s, 0.6, 0.5);
    kept = fv_case_run(&c, 100000, SANITIZED ? 0.1 : 1.0) ? 0.0 : NAN;
    BLOCK_ROWS (&s->b, 0, at, n)
        for (int64_t i = at; i < at + n; i++)
            most = fmax(most, hypot(s->u[0][i] - 1.0, s->u[1][i]));
    fv_free(&c.s);
    return kept + most / 0.25;
}

TEST(vortices_leave)
{
    static const char *const integrators[] = {"fv.integrator=\"rk3\"", "fv.integrator=\"bdf2\"",
                                              "fv.integrator=\"newton\""};
    static const double cfl[] = {1.0, 0.4, 1.0};
    for (int k = 0; k < 3; k++) {
        const double given = left_behind(integrators[k], cfl[k], false),
                     carried = left_behind(integrators[k], cfl[k], true);
        print_message("%s: %.2g of the vortex stays, with given pressure %.2g\n", integrators[k],
                      carried, given);
        assert_true(SANITIZED ? isfinite(carried + given) : carried < 0.03);
    }
}

/* (1 - c L) x = r between walls of all kinds and between none, from a thousandth of a cell to fifty
 * of them: to the tolerance that is asked, in as many passes as the bounds of the spectrum say. */
TEST(viscous_solve_keeps_its_word)
{
    static const char *const periodic[] = {CLOSED, "domain.periodic=(true,false)",
                                           "domain.periodic=(true,true)"};
    static const int first[] = {SIDE_X_MIN, SIDE_Y_MIN, SIDE_Y_MAX + 1};
    for (int k = 0; k < 18; k++) {
        struct fv_case c;
        double *out[2], sums[2] = {0.0, 0.0};
        const double reach = 1e-3 * pow(10.0, k / 3); /* c nu/h^2 */
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){"initial.field=\"rest\"", periodic[k % 3], "fluid.nu=0.1",
                                          "fv.cells=(24,36)", NULL});
        for (int side = first[k % 3]; side <= SIDE_Y_MAX; side++)
            wall_add(&c, (enum scene_side)side, side == SIDE_X_MAX ? WALL_SLIP : WALL_NO_SLIP, 0.0);
        struct fv *s = fv_case_start(&c, NULL);
        const double h = s->b.h[1], cc = reach * h * h / s->nu;
        for (int a = 0; a < 2; a++) {
            out[a] = block_field(&s->b);
            memset(s->delta[a], 0, (size_t)s->b.size * sizeof(double));
            BLOCK_CELLS (&s->b, i, j, kk, at)
                s->rhs[a][at] = out[a][at] = sin(1.0 + 7.3 * i * i + 3.1 * j * (a + 1) + kk);
        }
        s->totals.viscous_iterations = 0;
        assert_true(viscous_solve(s, cc, s->delta, s->rhs, 1e-8));
        bc_ghosts(s, BC_ZERO, s->delta);
        block_halo(&s->b, 2, s->delta);
        for (int a = 0; a < 2; a++) {
            viscous_apply(s, s->delta[a], s->rhs[a]);
            BLOCK_CELLS (&s->b, i, j, kk, at) {
                const double left = out[a][at] - s->delta[a][at] + cc * s->rhs[a][at];
                sums[0] += left * left;
                sums[1] += out[a][at] * out[a][at];
            }
            mem_free(out[a]);
        }
        const double kappa = 1.0 + reach * 7.8 * (1.0 + 24.0 * 24.0 / (36.0 * 36.0));
        const int rounds = k % 3 == 2 ? 2 : 1; /* single precision cannot tell 1e-8 */
        print_message("c nu/h^2 = %g: residual %.2g, %d passes\n", reach, sqrt(sums[0] / sums[1]),
                      (int)s->totals.viscous_iterations);
        assert_true(sqrt(sums[0] / sums[1]) <= 1e-8);
        assert_true((double)s->totals.viscous_iterations <=
                    4.0 * rounds +
                        (log(1e9) + rounds * log(2.0)) / acosh((kappa + 1.0) / (kappa - 1.0)));
        fv_free(&c.s);
    }
}
