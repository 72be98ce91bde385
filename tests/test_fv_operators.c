/* test_fv_operators.c - the finite-volume operators against averages of waves: fourth order on
 * cells that are no squares; symmetry; uniform flow; divergence after a step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "test.h"

#include "fv_case.h"

#include "../fv/forcing.h"

enum what { VALUE, GRADIENT, LAPLACE };

/* Phase k.x + 0.3 of a wave of `number' in the domain, and the factors that averaging over cells
 * gives. */
struct wave {
    double k[3], mean[3];
};

static struct wave wave_in(const struct block *b)
{
    static const int number[3] = {2, -1, 1};
    struct wave w = {{0}, {0}};
    for (int a = 0; a < 3; a++) {
        w.k[a] = a < b->dim ? 2.0 * M_PI * number[a] / (b->h[a] * b->cells[a]) : 0.0;
        const double x = 0.5 * w.k[a] * b->h[a];
        w.mean[a] = x != 0.0 ? sin(x) / x : 1.0;
    }
    return w;
}

static double phase(const struct wave *w, const double *x)
{
    return w->k[0] * x[0] + w->k[1] * x[1] + w->k[2] * x[2] + 0.3;
}

static void fill_wave(const struct block *b, const struct wave *w, double *q)
{
    double x[3];
    for (int k = 0; k < b->n[2]; k++)
        for (int j = 0; j < b->n[1]; j++)
            for (int i = 0; i < b->n[0]; i++) {
                block_centre(b, i, j, k, x);
                q[block_at(b, i, j, k)] = w->mean[0] * w->mean[1] * w->mean[2] * cos(phase(w, x));
            }
    block_halo(b, 1, &q);
}

/* Average over the lower face along a, or over the cell. */
static double wanted(const struct block *b, const struct wave *w, const double *x, enum what what,
                     int a)
{
    const double cell = w->mean[0] * w->mean[1] * w->mean[2];
    double at[3] = {x[0], x[1], x[2]};
    if (what == GRADIENT)
        return -cell * w->k[a] * sin(phase(w, at));
    if (what == LAPLACE)
        return -cell * (w->k[0] * w->k[0] + w->k[1] * w->k[1] + w->k[2] * w->k[2]) *
               cos(phase(w, at));
    at[a] -= 0.5 * b->h[a];
    return cell / w->mean[a] * cos(phase(w, at));
}

/* Largest error, relative to the largest value, along axis a. */
static double error_of(struct fv *s, enum what what, int a)
{
    const struct block *b = &s->b;
    const struct wave w = wave_in(b);
    double *out = what == VALUE ? s->U[a] : s->rhs[0], most = 0.0, scale = 0.0, x[3];
    for (int c = 0; c < b->dim; c++)
        fill_wave(b, &w, s->u[c]);
    if (what == VALUE)
        convection_face_velocities(s, s->u, s->U);
    else if (what == GRADIENT)
        gradient(s, s->u[0], a, CONTINUE_CUBIC, out);
    else
        viscous_apply(s, s->u[0], out);
    for (int k = 0; k < b->n[2]; k++)
        for (int j = 0; j < b->n[1]; j++)
            for (int i = 0; i < b->n[0]; i++) {
                block_centre(b, i, j, k, x);
                const double v = wanted(b, &w, x, what, a) * (what == LAPLACE ? s->nu : 1.0);
                most = fmax(most, fabs(out[block_at(b, i, j, k)] - v));
                scale = fmax(scale, fabs(v));
            }
    return most / scale;
}

static void has_order_four(int dim, enum what what)
{
    static const char *const dims[] = {"domain.dim=2", "domain.dim=3"};
    static const char *const cells[] = {"fv.cells=(32,20,16)", "fv.cells=(64,40,32)"};
    for (int a = 0; a < (what == LAPLACE ? 1 : dim); a++) {
        double e[2];
        for (int fine = 0; fine < 2; fine++) {
            struct fv_case c;
            fv_case_set(&c, MPI_COMM_WORLD,
                        (const char *const[]){dims[dim - 2], cells[fine],
                                              "domain.max=(1.0,1.2,0.7)",
                                              "initial.field=\"uniform\"", NULL});
            fv_case_start(&c, NULL);
            e[fine] = error_of(c.s, what, a);
            fv_free(&c.s);
        }
        if (!(fv_case_order(e[0], e[1]) >= 3.8 && e[1] < 2e-3))
            fail_msg("%dD operator %d axis %d: %g, %g, order %.2f", dim, what, a, e[0], e[1],
                     fv_case_order(e[0], e[1]));
    }
}

static void face_values_have_order_four(void **state)
{
    (void)state;
    has_order_four(2, VALUE);
    has_order_four(3, VALUE);
}

static void gradient_has_order_four(void **state)
{
    (void)state;
    has_order_four(2, GRADIENT);
    has_order_four(3, GRADIENT);
}

static void viscous_operator_has_order_four(void **state)
{
    (void)state;
    has_order_four(2, LAPLACE);
    has_order_four(3, LAPLACE);
}

static void fill_random(const struct fv *s, double *q)
{
    BLOCK_ROWS(&s->b, 0, c, n)
    for (int64_t i = c; i < c + n; i++)
        q[i] = (double)rand() / RAND_MAX - 0.5;
    if (s->forcing)
        forcing_zero(s->forcing, q);
    block_halo(&s->b, 1, &q);
}

static double product(const struct fv *s, const double *x, const double *y)
{
    double sum = 0.0;
    BLOCK_ROWS(&s->b, 0, c, n)
    for (int64_t i = c; i < c + n; i++)
        sum += x[i] * y[i];
    return sum;
}

/* x.Ly = y.Lx and x.Lx < 0, which conjugate gradients need; also next to forced cells. */
static void viscous_operator_is_symmetric(void **state)
{
    static const char *const cases[3][6] = {
        {"fv.cells=(16,12)", "domain.max=(1.0,1.3)", NULL},
        {"domain.dim=3", "fv.cells=(12,10,8)", "domain.max=(1.0,1.3,0.5)", NULL},
        {"fv.cells=(32,32)", "fv.hole=((0.3125,0.3125),(0.6875,0.6875))", NULL}};
    (void)state;
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

static void uniform_flow_stays(void **state)
{
    static const char *const dims[] = {"domain.dim=2", "domain.dim=3"};
    static const char *const ways[] = {"fv.integrator=\"rk3\"", "fv.integrator=\"bdf2\""};
    static const double wanted_u[3] = {0.7, -0.4, 0.3};
    (void)state;
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
            BLOCK_ROWS(&c.s->b, 0, at, n)
        for (int64_t i = at; i < at + n; i++)
            most = fmax(most, fabs(c.s->u[a][i] - wanted_u[a]));
        assert_close(most, 0.0, 1e-12);
        fv_free(&c.s);
    }
}

/* From a rough start; the divergence it had and the one that a step leaves, both times h. */
static void step_leaves_no_divergence(void **state)
{
    static const char *const cases[3][6] = {
        {"fv.cells=(32,32)", "fv.tol_pressure=1e-10", NULL},
        {"fv.cells=(32,32)", "fv.tol_pressure=1e-10", "fv.hole=((0.3125,0.3125),(0.6875,0.6875))",
         NULL},
        {"fv.cells=(16,16,8)", "fv.tol_pressure=1e-10", "domain.dim=3", NULL}};
    (void)state;
    for (int k = 0; k < 3; k++) {
        struct fv_case c;
        double row[FV_CASE_ROW];
        fv_case_set(&c, MPI_COMM_WORLD, cases[k]);
        struct fv *s = fv_case_start(&c, NULL);
        for (int a = 0; a < s->b.dim; a++) {
            BLOCK_ROWS(&s->b, 0, at, n)
            for (int64_t i = at; i < at + n; i++)
                s->u[a][i] += 0.1 * ((double)rand() / RAND_MAX - 0.5);
        }
        block_halo(&s->b, s->b.dim, s->u);
        convection_face_velocities(s, s->u, s->U);
        fv_row(s, row);
        assert_true(row[2] > 0.02); /* the test tests something */
        assert_true(fv_case_run(&c, 1, 100.0));
        fv_row(s, row);
        assert_close(row[2], 0.0, 1e-10);
        fv_free(&c.s);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(face_values_have_order_four),
                                       cmocka_unit_test(gradient_has_order_four),
                                       cmocka_unit_test(viscous_operator_has_order_four),
                                       cmocka_unit_test(viscous_operator_is_symmetric),
                                       cmocka_unit_test(uniform_flow_stays),
                                       cmocka_unit_test(step_leaves_no_divergence)};
    MPI_Init(&argc, &argv);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    MPI_Finalize();
    return failed;
}
