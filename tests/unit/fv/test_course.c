/* test_course.c - what a partner is told of FV's fields in time: polynomials through levels at any
 * times; a window that is tried and taken back leaves no trace. ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/coupling/fv_course.h"
#include "fv_case.h"

static const double box[2][3] = {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}};

static struct fv *start(struct fv_case *c)
{
    const char *const overrides[] = {"fv.cells=(16,16)", NULL};
    fv_case_set(c, MPI_COMM_WORLD, overrides);
    struct fv *s = fv_case_start(c, NULL);
    s->forcing = mem_own(s, forcing_create(s, 1, &box, true));
    return s;
}

/* A polynomial in time, another for every place. */
static double course_of(int degree, int64_t place, double t)
{
    const double a[4] = {1.0 + 0.1 * (double)(place % 7), -2.0, 0.5 * (double)(place % 3), 3.0};
    double v = 0.0;
    for (int k = degree; k >= 0; k--)
        v = v * t + a[k];
    return v;
}

static void set_level(const struct course *c, double *q, int degree, double t)
{
    for (int64_t i = 0; i < c->n * (c->dim + 1); i++)
        q[i] = course_of(degree, i, t);
}

/* Largest difference between the terms' sum and the polynomial, over the next window. */
static double worst(const struct course *c, int nterms, int ncomp, int degree, int first)
{
    double most = 0.0;
    for (int64_t i = 0; i < c->n; i++)
        for (int a = 0; a < ncomp; a++)
            for (int m = 0; m <= 4; m++) {
                const double tau = 0.05 * m;
                double v = 0.0;
                for (int k = nterms - 1; k >= 0; k--)
                    v = v * tau + c->term[k][i * ncomp + a];
                most = fmax(
                    most, fabs(v - course_of(degree, i * (c->dim + 1) + first + a, c->t[0] + tau)));
            }
    return most;
}

TEST(velocity_follows_cubics_and_pressure_lines)
{
    static const double t[COURSE_LEVELS] = {0.7, 0.55, 0.3};
    struct fv_case k;
    struct fv *s = start(&k);
    struct patch of_cells;
    assert_true(patch_create(s, 0, NULL, NULL, &of_cells, NULL));
    struct course *c = course_create(s, &of_cells, 1);
    for (int tried = 0; tried < 2; tried++) {
        const int degree = tried ? 3 : 2;
        for (int m = 0; m < COURSE_LEVELS; m++) {
            c->t[m] = t[m];
            set_level(c, c->q[m], degree, t[m]);
        }
        c->levels = COURSE_LEVELS;
        c->t_tried = tried ? 0.9 : -INFINITY;
        set_level(c, c->tried, degree, 0.9);
        assert_int_equal(course_velocity(c), degree + 1);
        assert_true(worst(c, degree + 1, c->dim, degree, 0) < 1e-11);
    }
    for (int m = 0; m < COURSE_LEVELS; m++)
        set_level(c, c->q[m], 1, t[m]);
    set_level(c, c->tried, 1, 0.9);
    assert_true(worst(c, course_pressure(c), 1, 1, c->dim) < 1e-12);
    FREE(c);
    fv_free(&k.s);
}

/* Without trials [6.9-6.10]: value and slope now, exact of parabolas whatever the steps; a trial is
 * not made. */
TEST(lines_have_the_slope_of_parabolas)
{
    static const double t[COURSE_LEVELS] = {0.7, 0.55, 0.3};
    struct fv_case k;
    struct fv *s = start(&k);
    s->run->scene.coupling.in_time = 1;
    struct patch of_cells;
    assert_true(patch_create(s, 0, NULL, NULL, &of_cells, NULL));
    struct course *c = course_create(s, &of_cells, 1);
    course_start(s, c, 1e-3);
    course_try(s, c, s->t + 0.01);
    assert_true(!(c->t_tried > c->t[0]));
    for (int m = 0; m < COURSE_LEVELS; m++) {
        c->t[m] = t[m];
        set_level(c, c->q[m], 2, t[m]);
    }
    for (int first = 0; first <= c->dim; first += c->dim) {
        const int ncomp = first ? 1 : c->dim;
        assert_int_equal(first ? course_pressure(c) : course_velocity(c), 2);
        for (int64_t i = 0; i < c->n; i++)
            for (int a = 0; a < ncomp; a++) {
                const int64_t place = i * (c->dim + 1) + first + a;
                const double rise = -2.0 + (double)(place % 3) * t[0]; /* of course_of */
                assert_close(c->term[0][i * ncomp + a], course_of(2, place, t[0]), 1e-12);
                assert_close(c->term[1][i * ncomp + a], rise, 1e-11);
            }
    }
    FREE(c);
    s->run->scene.coupling.in_time = 0;
    fv_free(&k.s);
}

TEST(forced_values_follow_parabolas)
{
    struct fv_case k;
    struct fv *s = start(&k);
    struct forcing *f = s->forcing;
    for (int known = 1; known <= 3; known++) {
        f->t_old = 0.1;
        f->t0 = 0.25;
        f->t1 = 0.3;
        f->levels = known;
        for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
            f->v_old[0][i] = known > 2 ? course_of(known - 1, i, f->t_old) : NAN;
            f->v[0][i] = known > 1 ? course_of(known - 1, i, f->t0) : NAN;
            f->v_next[0][i] = course_of(known - 1, i, f->t1);
        }
        forcing_shift(f, 0.3, 0.42);
        assert_int_equal(f->levels, known < 3 ? known + 1 : 3);
        assert_true(f->t_old == 0.25 && f->t0 == 0.3 && f->t1 == 0.42);
        for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
            assert_true(f->v[0][i] == course_of(known - 1, i, 0.3));
            assert_true(fabs(f->v_next[0][i] - course_of(known - 1, i, 0.42)) < 1e-13);
        }
    }
    fv_free(&k.s);
}

static void run(struct fv_case *k, const char *integrator, bool tries)
{
    const double T = 0.07;
    const char *const overrides[] = {"fv.cells=(16,16)", integrator,
                                     "fv.hole=((0.25,0.25,0),(0.75,0.75,0))", NULL};
    fv_case_set(k, MPI_COMM_WORLD, overrides);
    struct fv *s = fv_case_start(k, NULL);
    struct patch of_cells;
    assert_true(patch_create(s, 0, NULL, NULL, &of_cells, NULL));
    struct course *c = course_create(s, &of_cells, 1);
    course_start(s, c, 1e-3);
    for (int window = 0; window < 3; window++) {
        if (tries) {
            course_try(s, c, (window + 1) * T);
            assert_true(c->t_tried > s->t && s->t < (window + 0.5) * T && !s->step.predicts);
        }
        assert_true(fv_case_run(k, 100, (window + 1) * T));
        course_take(s, c);
    }
    FREE(c);
}

TEST(a_trial_leaves_no_trace)
{
    static const char *const integrators[] = {"fv.integrator=\"rk3\"", "fv.integrator=\"bdf2\"",
                                              "fv.integrator=\"newton\""};
    for (int m = 0; m < 3; m++) {
        struct fv_case a, b;
        run(&a, integrators[m], false);
        run(&b, integrators[m], true);
        assert_true(a.s->totals.iterations == b.s->totals.iterations &&
                    a.s->totals.max_cfl == b.s->totals.max_cfl);
        BLOCK_ROWS (&a.s->b, 0, c, n) {
            assert_memory_equal(a.s->u[0] + c, b.s->u[0] + c, (size_t)n * sizeof(double));
            assert_memory_equal(a.s->p + c, b.s->p + c, (size_t)n * sizeof(double));
        }
        fv_free(&a.s);
        fv_free(&b.s);
    }
}
