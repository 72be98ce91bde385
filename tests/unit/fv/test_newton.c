/* test_newton.c - the derivative of the residual is its derivative; Newton's residual decays
 * quadratically and GMRES needs no more vectors on finer grids; second order in time; large steps;
 * steady states. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <kinsol/kinsol.h>

#include "../../../fv/time/newton.h"
#include "fv_bc_case.h"
#include "newton_case.h"

#define NEWTON "fv.integrator=\"newton\""
#define MODES NEWTON, "initial.field=\"two_modes\"", "initial.velocity=(0.5,0.25)"

static void fill_random(const struct fv *s, N_Vector v, const double *scale)
{
    double *q = N_VGetArrayPointer(v);
    for (int64_t i = 0; i < (s->b.dim + 1) * s->newton->cells; i++)
        q[i] = scale[i >= s->newton->cells] * ((double)rand() / RAND_MAX - 0.5);
}

/* Relative difference of J v and the residual's central difference at a rough state. */
static double jacobian_error(struct fv_case *c)
{
    struct fv *s = fv_case_start(c, NULL);
    struct newton *w = s->newton;
    const double e = 1e-4;
    N_Vector v = N_VClone(w->q), q = N_VClone(w->q), up = N_VClone(w->q), down = N_VClone(w->q);
    booleantype is_new = SUNTRUE;
    newton_set_step(s, 0.05, 0.03);
    fill_random(s, v, (const double[]){1.0, 1.0});
    fill_random(s, w->q, (const double[]){1.0, 1.0});
    N_VScale(0.0, w->q, w->q1);
    N_VScale(0.0, w->q, w->q2);
    newton_jacobian_times(v, w->residual, w->q, &is_new, s);
    N_VScale(1.0, w->residual, q);
    N_VLinearSum(1.0, w->q, e, v, w->q1);
    N_VScale(1.0, w->q1, w->residual);
    N_VScale(0.0, w->q1, w->q1);
    newton_residual(w->residual, up, s);
    N_VLinearSum(1.0, w->q, -e, v, w->residual);
    newton_residual(w->residual, down, s);
    N_VLinearSum(0.5 / e, up, -0.5 / e, down, up);
    N_VLinearSum(1.0, up, -1.0, q, down);
    const double error = sqrt(N_VDotProd(down, down) / N_VDotProd(q, q));
    N_Vector const own[] = {v, q, up, down};
    for (int k = 0; k < 4; k++)
        N_VDestroy(own[k]);
    fv_free(&c->s);
    return error;
}

TEST(jacobian_is_the_derivative)
{
    static const char *const cases[6][6] = {
        {MODES, "fv.cells=(16,12)", "fv.flux=\"upwind\"", NULL},
        {MODES, "fv.cells=(16,12)", "fv.c0=3.0", NULL},
        {MODES, "fv.cells=(16,16)", "fv.hole=((0.3125,0.3125),(0.6875,0.6875))", NULL},
        {NEWTON, "domain.dim=3", "fv.cells=(8,6,4)", "fv.flux=\"upwind\"", NULL},
        {NEWTON, CLOSED, "fv.cells=(12,8)", "initial.field=\"rest\"", NULL},
        {NEWTON, CLOSED, "fv.cells=(12,20)", "fv.graded=(0.6,10)", NULL}};
    for (int k = 0; k < 6; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF, cases[k]);
        if (k == 4) {
            wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0)->profile = PROFILE_PARABOLIC;
            wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
            wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.5);
            wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
        }
        const double error = jacobian_error(&c);
        print_message("case %d: %.3g\n", k, error);
        assert_true(error < 1e-7);
    }
}

TEST(preconditioner_is_linear)
{
    static const char *const cells[] = {"fv.cells=(8,32)", "fv.cells=(16,12)", "fv.cells=(10,26)",
                                        "fv.cells=(8,8)"};
    static const char *const sides[] = {"domain.periodic=(true,false)", CLOSED,
                                        "domain.periodic=(true,true)"};
    for (int k = 0; k < 12; k++) {
        struct fv_case c;
        fv_case_set(
            &c, MPI_COMM_SELF,
            (const char *const[]){NEWTON, "fluid.nu=0.1", cells[k % 4], sides[k / 4], NULL});
        if (k < 8) {
            wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
            wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 0.0);
        }
        if (k / 4 == 1) {
            wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0);
            wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
        }
        struct fv *s = fv_case_start(&c, NULL);
        const double error = newton_precond_bends(s);
        print_message("%s, %s: %.3g\n", cells[k % 4], sides[k / 4], error);
        assert_true(error < 1e-12);
        fv_free(&c.s);
    }
}

/* Exact linear solves, one iteration at a time: log r_k+1/log r_k of the relative residuals. */
TEST(residual_decays_quadratically)
{
    struct fv_case c;
    double r[8] = {0.0}, best = 0.0;
    fv_case_set(&c, MPI_COMM_SELF, (const char *const[]){MODES, "fv.cfl=5", NULL});
    struct fv *s = fv_case_start(&c, NULL);
    struct newton *w = s->newton;
    assert_true(fv_case_run(&c, 1, 10.0)); /* scales and vectors of a step */
    newton_set_step(s, s->step.dt, 0.0);
    newton_pack(s, s->p, s->u, w->q1);
    N_VScale(0.5, w->q1, w->q);
    KINSetEtaForm(w->kin, KIN_ETACONSTANT);
    KINSetNumMaxIters(w->kin, 1);
    KINSetFuncNormTol(w->kin, 1e-15);
    for (int k = 0; k < 8; k++) {
        newton_residual(w->q, w->residual, s);
        r[k] = N_VWrmsNorm(w->residual, w->fscale);
        if (k >= 2 && r[k] > 1e-11 * r[0])
            best = fmax(best, log(r[k] / r[k - 1]) / log(r[k - 1] / r[k - 2]));
        KINSetEtaConstValue(w->kin, 1e-9);
        KINSol(w->kin, w->q, KIN_LINESEARCH, w->uscale, w->fscale);
    }
    print_message("residuals %.3g %.2g %.2g %.2g %.2g %.2g, order %.2f\n", r[0], r[1], r[2], r[3],
                  r[4], r[5], best);
    assert_true(best > 1.8 && r[5] < 1e-10 * r[0]);
    fv_free(&c.s);
}

static double vectors_at(int n, const char *cfl)
{
    struct fv_case c;
    char cells[64];
    snprintf(cells, sizeof cells, "fv.cells=(%d,%d)", n, n);
    fv_case_set(&c, MPI_COMM_SELF, (const char *const[]){MODES, cells, cfl, NULL});
    fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 3, 100.0));
    const double vectors = (double)c.s->newton->krylovs / (double)c.s->newton->newtons;
    fv_free(&c.s);
    return vectors;
}

TEST(vectors_do_not_grow_with_the_grid)
{
    for (int k = 0; k < (SANITIZED ? 1 : 2); k++) {
        const char *const cfl = k ? "fv.cfl=20" : "fv.cfl=5";
        const double v24 = vectors_at(24, cfl), v48 = vectors_at(48, cfl),
                     v96 = vectors_at(96, cfl);
        print_message("%s: vectors an iteration %.1f %.1f %.1f\n", cfl, v24, v48, v96);
        assert_true(v96 < 1.4 * v24 && v96 < 12.0);
    }
}

/* dt and h halved together: momentum interpolation ties the one to the other. */
TEST(time_is_second_order)
{
    static const char *const common[] = {MODES, "fv.cfl=0.5", NULL};
    if (SANITIZED)
        skip();
    for (int k = 0; k < 2; k++) {
        const char *const flux = k ? "fv.flux=\"upwind\"" : NULL;
        const double e32 = fv_case_error_at(32, common, flux, 0.25),
                     e64 = fv_case_error_at(64, common, flux, 0.25);
        print_message("%s: %.3g %.3g, order %.2f\n", k ? "upwind" : "central", e32, e64,
                      fv_case_order(e32, e64));
        assert_true(fv_case_order(e32, e64) > 1.9);
    }
}

/* Vortices whose steps are short for what they change: residuals of all steps add up, and at 1e-6
 * left ten times the error of time on 128 cells. */
TEST(tolerance_follows_short_steps)
{
    static const char *const common[] = {NEWTON, "fv.cfl=0.5", NULL};
    if (SANITIZED)
        skip();
    const double e64 = fv_case_error_at(64, common, NULL, 0.25),
                 e128 = fv_case_error_at(128, common, NULL, 0.25);
    print_message("Taylor-Green: %.3g, %.3g, order %.2f\n", e64, e128, fv_case_order(e64, e128));
    assert_true(fv_case_order(e64, e128) > 1.9);
}

/* Energy only falls, at any step, also when the step changes by ten. */
TEST(large_steps_are_stable)
{
    static const char *const cfl[] = {"fv.cfl=50", "fv.cfl=100"};
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        double row[FV_CASE_ROW], last;
        fv_case_set(&c, MPI_COMM_SELF, (const char *const[]){MODES, cfl[k], NULL});
        struct fv *s = fv_case_start(&c, NULL);
        VALUES_OF(fv_row, s, row);
        last = row[0];
        for (int n = 0; n < 12; n++) {
            s->prm.cfl *= n % 4 == 1 ? 0.1 : n % 4 == 3 ? 10.0 : 1.0;
            assert_true(fv_case_run(&c, 1, 1000.0));
            VALUES_OF(fv_row, s, row);
            assert_true(row[0] < (1.0 + 1e-6) * last);
            last = row[0];
        }
        fv_free(&c.s);
    }
}

TEST(sound_is_swallowed)
{
    struct fv_case c[2];
    double most = 0.0;
    for (int k = 0; k < 2; k++) {
        fv_case_set(c + k, MPI_COMM_SELF,
                    (const char *const[]){NEWTON, "fv.cfl=2", k ? "fv.c0=10" : NULL, NULL});
        fv_case_start(c + k, NULL);
        assert_true(fv_case_run(c + k, 100, 1.0));
    }
    BLOCK_ROWS (&c[0].s->b, 0, at, n)
        for (int64_t i = at; i < at + n; i++)
            most = fmax(most, fabs(c[0].s->u[0][i] - c[1].s->u[0][i]));
    print_message("c = 10 U against incompressible: %.3g\n", most);
    assert_true(most > 1e-6 && most < 1e-2); /* Mach number squared */
    for (int k = 0; k < 2; k++)
        fv_free(&c[k].s);
}

static void cavity(struct fv_case *c, const char *cells, const char *more)
{
    fv_case_set(c, MPI_COMM_SELF,
                (const char *const[]){NEWTON, CLOSED, "initial.field=\"rest\"", "fluid.nu=1e-3",
                                      "fv.steady=true", "fv.cfl=10", "time.end=60", cells,
                                      "fv.extrema=(-0.3885698,0.3769447,-0.5270771)", more, NULL});
    for (int k = SIDE_X_MIN; k <= SIDE_Y_MAX; k++)
        wall_add(c, (enum scene_side)k, WALL_NO_SLIP, k == SIDE_Y_MAX ? 1.0 : 0.0);
    fv_case_start(c, NULL);
}

/* Re 1000 from rest, against Botella & Peyret (1998). */
static double cavity_error(const char *cells, const char *more, struct newton *after)
{
    struct fv_case c;
    double error = NAN;
    cavity(&c, cells, more);
    c.run.summary = summary_create();
    assert_true(fv_case_run(&c, 1000, 60.0));
    fv_summarise_extrema(c.s);
    assert_true(summary_find(c.run.summary, "error.extrema", &error));
    *after = *c.s->newton;
    print_message("%lld iterations, %lld vectors, residual %.3g, error %.4g\n",
                  (long long)after->newtons, (long long)after->krylovs, after->norm, error);
    assert_true(after->steady);
    DROP(c.run.summary);
    fv_free(&c.s);
    return error;
}

TEST(steady_cavity_takes_few_iterations)
{
    struct newton n;
    const double error = cavity_error("fv.cells=(32,32)", NULL, &n);
    assert_true(n.newtons < 30 && error < 0.021);
    assert_true(n.norm < 1e-6);
}

/* Cells of aspect 100: a pseudo step whose linear system stays unsolved is not made again and
 * again. GMRES has 200 vectors an iteration; 22 of 26 used all of them. No more now than 20 such.
 */
TEST(pseudo_steps_stay_within_what_gmres_solves)
{
    struct fv_case c;
    cavity(&c, SANITIZED ? "fv.cells=(12,12)" : "fv.cells=(32,32)", "domain.max=(100,1)");
    assert_true(fv_case_run(&c, 1000, 60.0));
    const struct newton *n = c.s->newton;
    print_message("aspect 100: %lld iterations, %lld vectors\n", (long long)n->newtons,
                  (long long)n->krylovs);
    assert_true(n->steady && n->newtons < 60 && n->krylovs < 20 * 200);
    fv_free(&c.s);
}

/* What the residual at default settings leaves is below a twentieth of the cells' own error, and
 * that falls, from below what 32 cells are allowed to what second order makes of it. */
TEST(steady_residual_follows_the_cells)
{
    if (SANITIZED)
        skip();
    struct newton n;
    const double fine = cavity_error("fv.cells=(48,48)", NULL, &n),
                 exact = cavity_error("fv.cells=(48,48)", "fv.tol_newton=1e-10", &n);
    assert_close(fine / exact, 1.0, 0.05);
    assert_true(fine < 4.0 / 9.0 * 0.021);
}

/* Re 1e5 on cells far too coarse for it: upwind states still have a steady flow, and it is found.
 */
TEST(upwind_states_survive_coarse_cells)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){NEWTON, CLOSED, "initial.field=\"rest\"", "fluid.nu=1e-5",
                                      "fv.steady=true", "time.end=60", "fv.cells=(12,12)",
                                      "fv.flux=\"upwind\"", NULL});
    for (int k = SIDE_X_MIN; k <= SIDE_Y_MAX; k++)
        wall_add(&c, (enum scene_side)k, WALL_NO_SLIP, k == SIDE_Y_MAX ? 1.0 : 0.0);
    fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 1000, 60.0));
    print_message("Re 1e5, 12 x 12: %lld iterations, residual %.3g\n",
                  (long long)c.s->newton->newtons, c.s->newton->norm);
    assert_true(c.s->newton->steady && c.s->newton->newtons < 100);
    fv_free(&c.s);
}

/* Re 1e9 on 8 x 8 cells has no steady state that is found: the reason says what is left, where.
 */
TEST(hopeless_flow_stops_with_a_reason)
{
    struct fv_case c;
    struct diagnosis d = {0};
    cavity(&c, "fv.cells=(8,8)", "fluid.nu=1e-9");
    while (!d.bad && c.s->t < 60.0)
        integrate(c.s, 60.0, &d);
    print_message("%s; %s; %s\n", d.reason, d.where, d.likely);
    assert_true(d.bad && isfinite(c.s->newton->norm));
    assert_non_null(strstr(d.reason, "the least")); /* and when the residual was lowest */
    assert_true(strlen(d.reason) > 20 && strlen(d.where) > 10 && strlen(d.likely) > 20);
    fv_free(&c.s);
}

/* A parabola on graded rows: only the dissipation keeps it from being exact, a thousandth of upwind
 * where nothing flows across; third differences along uneven rows leave it at order two to three.
 */
static double graded_channel(int n, bool openings)
{
    struct fv_case c;
    char cells[32], graded[32];
    double error = 0.0;
    snprintf(cells, sizeof cells, "fv.cells=(8,%d)", n);
    snprintf(graded, sizeof graded, "fv.graded=(0.6,%d)", n / 2);
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){NEWTON, "fv.steady=true", "initial.field=\"rest\"",
                                      "fluid.nu=0.1", cells, graded, "fv.tol_newton=1e-11",
                                      openings ? CLOSED : "domain.periodic=(true,false)", NULL});
    c.run.scene.fluid.gravity[0] = openings ? 0.0 : 0.8;
    wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 0.0);
    if (openings) {
        wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0)->profile = PROFILE_PARABOLIC;
        wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
    }
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, 1000, 1.0));
    for (int j = 0; j < s->b.n[1]; j++) {
        const double h = s->b.rows->h[j], y = s->b.rows->y[j] - 0.5 * h;
        const double u = 2.0 * (2.0 * y + h) - 4.0 / 3.0 * (3.0 * y * y + 3.0 * y * h + h * h);
        error = fmax(error, fabs(s->u[0][block_at(&s->b, 3, j, 0)] - u));
    }
    fv_free(&c.s);
    return error;
}

TEST(steady_channel_on_graded_rows)
{
    for (int k = 0; k < 2; k++) {
        const double coarse = graded_channel(20, k), fine = graded_channel(40, k);
        print_message("graded channel, %s: %.3g, %.3g\n", k ? "openings" : "periodic", coarse,
                      fine);
        assert_true(coarse < 1e-4 && fine < coarse / 4.0);
    }
}

/* A polynomial, so exact: driven by a force, or steady from an inflow to an outflow. */
TEST(steady_channels_are_exact)
{
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){NEWTON, "fv.steady=true", "initial.field=\"rest\"",
                                          "fluid.nu=0.1", "fv.cells=(16,16)", "fv.tol_newton=1e-11",
                                          "time.end=1", k ? CLOSED : "domain.periodic=(true,false)",
                                          NULL});
        if (k == 0)
            c.run.scene.fluid.gravity[0] = 0.8;
        wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
        wall_add(&c, SIDE_Y_MAX, WALL_NO_SLIP, 0.0);
        if (k == 1) {
            wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0)->profile = PROFILE_PARABOLIC;
            wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
        }
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 1000, 1.0));
        const double most = parabola_error(s);
        print_message("channel %d: %.3g, %lld iterations\n", k, most,
                      (long long)s->newton->newtons);
        assert_true(most < 1e-8 && s->newton->newtons < 40);
        fv_free(&c.s);
    }
}
