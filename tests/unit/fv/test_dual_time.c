/* test_dual_time.c - dual time stepping reaches what Newton's method does, on all kinds of cells;
 * its errors fall as theirs; what it does not solve is told. ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause
 */
#include "../test.h"

#include "../../../fv/time/newton.h"
#include "fv_bc_case.h"
#include "mesh_case.h"

#define NEWTON "fv.integrator=\"newton\""
#define TIGHT NEWTON, "fv.tol_newton=1e-9"
#define MODES "initial.field=\"two_modes\"", "initial.velocity=(0.5,0.25)"
#define DUAL "fv.dual_time=true"

enum { STEPS = 4 };

/* Both leave residuals of 1e-9 of velocity, which a step turns into no more than as many times that
 * as sound takes pseudo steps through the cells, some tens: 1e-7 with four steps. */
static void assert_same(const struct fv *s, const struct fv *other)
{
    double most = 0.0;
    for (int a = 0; a < s->dim; a++)
        FLOW_ROWS (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                most = fmax(most, fabs(s->u[a][i] - other->u[a][i]));
    print_message("velocities differ by %.2g, %lld pseudo steps for %lld iterations\n", most,
                  (long long)s->newton->newtons, (long long)other->newton->newtons);
    assert_true(isfinite(s->max.rate) && s->t == other->t);
    assert_true(most < 1e-7 * fmax(s->max.u[0], s->max.u[1]));
    assert_true(s->newton->halvings == 0 && s->newton->krylovs == 0);
}

static void start_duct(struct fv_case *c)
{
    wall_add(c, SIDE_X_MIN, WALL_INFLOW, 1.0)->profile = PROFILE_PARABOLIC;
    wall_add(c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
    wall_add(c, SIDE_Y_MIN, WALL_NO_SLIP, 0.5);
    wall_add(c, SIDE_Y_MAX, WALL_SLIP, 0.0);
}

TEST(it_solves_newtons_equations)
{
    static const char *const cases[][8] = {
        {TIGHT, MODES, "fv.cells=(24,16)", NULL},
        {TIGHT, MODES, "fv.cells=(16,16)", "fv.flux=\"upwind\"", "fv.cfl=5", NULL},
        {TIGHT, MODES, "fv.cells=(24,16)", "fv.pseudo_memory=0", NULL},
        {TIGHT, "fv.cells=(16,12)", "fv.c0=3.0", NULL},
        {TIGHT, MODES, "fv.cells=(16,16)", "fv.hole=((0.3125,0.3125),(0.6875,0.6875))", NULL},
        {TIGHT, "domain.dim=3", "fv.cells=(8,12,6)", NULL},
        {TIGHT, CLOSED, "fv.cells=(12,8)", "initial.field=\"rest\"", NULL},
        {TIGHT, CLOSED, "fv.cells=(12,20)", "fv.graded=(0.6,10)", "initial.field=\"rest\"", NULL}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        struct fv_case c[2];
        for (int with = 0; with < 2; with++) {
            const char *all[10] = {NULL};
            int n = 0;
            for (const char *const *o = cases[k]; *o; o++)
                if (with || strcmp(*o, "fv.pseudo_memory=0") != 0)
                    all[n++] = *o;
            all[n] = with ? DUAL : NULL;
            fv_case_set(c + with, MPI_COMM_SELF, all);
            if (k > 5)
                start_duct(c + with);
            fv_case_start(c + with, NULL);
            assert_true(fv_case_run(c + with, STEPS, 100.0));
        }
        assert_same(c[1].s, c[0].s);
        fv_free(&c[0].s);
        fv_free(&c[1].s);
    }
}

/* Joined, turned over another one, and a ring with walls whose cells are flat. */
TEST(it_does_on_blocks)
{
    static const char *const blocks[] = {
        "{ name = \"w\"; cells = (8, 16); max = (0.5, 1.0); i_min = \"periodic\"; i_max = "
        "\"joined\"; j_min = \"periodic\"; j_max = \"periodic\"; }, "
        "{ name = \"e\"; cells = (8, 16); min = (0.5, 0.0); max = (1.0, 1.0); i_min = \"joined\"; "
        "i_max = \"periodic\"; j_min = \"periodic\"; j_max = \"periodic\"; }",
        "{ name = \"square\"; cells = (24, 24); " PERIODIC
        "}, { name = \"turned\"; cells = (16, 16); min = (0.22, 0.22); max = (0.78, 0.78); centre "
        "= (0.5, 0.5); angle = 30.0; }",
        "{ name = \"ring\"; mapping = \"annulus\"; i_min = \"wall\"; i_max = \"wall\"; j_min = "
        "\"joined\"; j_max = \"joined\"; radius = (0.5, 1.0); spin = (2.0, -0.5); cells = (24, "
        "16); }"};
    for (int k = 0; k < 3; k++) {
        struct mesh_case c[2];
        struct fv *s[2];
        for (int with = 0; with < 2; with++) {
            s[with] = mesh_case_start(
                c + with, MPI_COMM_WORLD, blocks[k],
                (const char *const[]){TIGHT, k == 2 ? "initial.field=\"couette\"" : "fv.cfl=1",
                                      with ? DUAL : NULL, NULL});
            assert_true(mesh_case_run(s[with], STEPS, 100.0));
        }
        assert_same(s[1], s[0]);
        mesh_case_end(c, s);
        mesh_case_end(c + 1, s + 1);
    }
}

/* Taylor-Green, dt and h halved together, at the default tolerance: second order, as in theory, and
 * no more than a tenth beside Newton's method. The projection has another error, and the difference
 * between both falls as fast. */
TEST(taylor_green_is_second_order)
{
    static const char *const dual[] = {NEWTON, DUAL, "fv.cfl=0.5", NULL},
                             *const newton[] = {NEWTON, "fv.cfl=0.5", NULL},
                             *const projection[] = {"fv.integrator=\"bdf2\"", "fv.cfl=0.5", NULL};
    if (SANITIZED)
        skip();
    double e[2], difference[2];
    for (int k = 0; k < 2; k++) {
        const int n = k ? 32 : 16;
        const double other = fv_case_error_at(n, newton, NULL, 0.25);
        e[k] = fv_case_error_at(n, dual, NULL, 0.25);
        difference[k] = fabs(e[k] - fv_case_error_at(n, projection, NULL, 0.25));
        print_message("%d cells: %.3g, newton %.3g, from the projection's %.3g\n", n, e[k], other,
                      difference[k]);
        assert_close(e[k] / other, 1.0, 0.1);
    }
    assert_true(fv_case_order(e[0], e[1]) > 1.9);
    assert_true(fv_case_order(difference[0], difference[1]) > 1.9);
}

/* Few pseudo steps, or long ones that grow: the step is halved, and then the reason is told. */
TEST(what_does_not_converge_is_told)
{
    static const char *const bad[] = {"fv.pseudo_steps=3", "fv.pseudo_cfl=5"};
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        struct diagnosis d = {0};
        fv_case_set(&c, MPI_COMM_WORLD, (const char *const[]){NEWTON, MODES, DUAL, bad[k], NULL});
        struct fv *s = fv_case_start(&c, NULL);
        while (!d.bad && s->t < 1.0)
            integrate(s, 1.0, &d);
        print_message("%s; %s; %s\n", d.reason, d.where, d.likely);
        assert_true(d.bad && s->newton->halvings > 0);
        assert_non_null(strstr(d.reason, "dual time stepping leaves a residual of"));
        assert_non_null(strstr(d.likely, "fv.pseudo_cfl below"));
        fv_free(&c.s);
    }
}
