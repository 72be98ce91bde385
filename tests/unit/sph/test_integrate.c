/* test_integrate.c - time integration: its order, what it keeps, and restart bit for bit.
 * ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/neighbours.h"
#include "../../../sph/time/extremes.h"
#include "../../../sph/time/integrate.h"
#include "../../../sph/time/runge_kutta.h"
#include "sph_restart.h"

/* dq/dt = k x q at fixed places: momentum turns with the angular velocity k. */
static const double turn = 3.0;

static void toy_gradients(struct sph *s)
{
    memset(s->p.slope, 0, (size_t)s->p.n * s->p.nslope * sizeof(double));
}

static void toy_rates(struct sph *s)
{
    memset(s->p.rate, 0, (size_t)s->p.n * s->p.nstate * sizeof(double));
    for (int i = 0; i < s->p.n; i++) {
        const double *q = s->p.y + (size_t)i * s->p.nstate + 2;
        double *rate = s->p.rate + (size_t)i * s->p.nstate + 2;
        rate[0] = -turn * q[1];
        rate[1] = turn * q[0];
    }
}

static const struct scheme toy = {.name = "toy", .gradients = toy_gradients, .rates = toy_rates};

static double toy_error(int integrator, int steps)
{
    struct sph_case c;
    const double t_end = 1.0;
    double error = 0.0;
    sph_case_set(&c, 2, 16);
    c.prm.integrator = integrator;
    sph_case_start(&c, NULL);
    double *before = sph_case_gather(c.s, 256);
    c.s->scheme = &toy;
    c.s->nu = 0.0;
    for (int k = 0; k < steps; k++) {
        c.s->step.dt_most = t_end / steps;
        assert_true(sph_case_run(&c, 1, t_end));
    }
    assert_true(c.s->t == t_end); /* the last step lands on it exactly */
    double *after = sph_case_gather(c.s, 256);
    for (int i = 0; i < 256; i++) {
        const double *q = before + 6 * i + 2, *r = after + 6 * i + 2;
        error = fmax(error, fabs(q[0] * cos(turn) - q[1] * sin(turn) - r[0]));
        error = fmax(error, fabs(q[0] * sin(turn) + q[1] * cos(turn) - r[1]));
    }
    FREE(before, after);
    DROP(c.s);
    return error;
}

TEST(order_is_four_or_two)
{
    const double rk4 = toy_error(INTEGRATOR_RK4, 16) / toy_error(INTEGRATOR_RK4, 32);
    const double j3 = toy_error(INTEGRATOR_J3, 16) / toy_error(INTEGRATOR_J3, 32);
    assert_true(rk4 > 15.0 && rk4 < 17.5);
    assert_true(j3 > 3.8 && j3 < 4.3);
}

/* Weights add up to 1, each stage is where its rates have brought it, order 2; and the bound on the
 * real axis is where the polynomial leaves the unit disc. */
TEST(stages_agree_with_their_polynomial)
{
    const int schemes[2] = {SCHEME_RIEMANN_ALE, SCHEME_DELTA};
    for (int k = 0; k < 4; k++) {
        const struct rk_stages *c = stages_of(k / 2, schemes[k % 2]);
        double sum = 0.0, moment = 0.0;
        for (int m = 0; m < c->n; m++) {
            sum += c->weight[m];
            moment += c->weight[m] * c->at[m];
            assert_true(m == 0 ? c->at[0] == 0.0 : c->at[m] == c->ahead[m - 1]);
        }
        assert_close(sum, 1.0, 1e-14);
        assert_close(moment, 0.5, 1e-14);
        for (int out = 0; out < 2; out++) {
            const double z = -c->real_axis * (out ? 1.01 : 0.99);
            double y = 1.0, end = 1.0;
            for (int m = 0; m < c->n; m++) {
                end += z * c->weight[m] * y;
                y = 1.0 + z * c->ahead[m] * y;
            }
            assert_true((fabs(end) > 1.0) == out);
        }
    }
}

TEST(resting_lattice_stays_at_rest)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct sph_case c;
        sph_case_set(&c, dim, dim == 2 ? 24 : 12);
        c.run.scene.initial.field = FIELD_REST;
        sph_case_start(&c, NULL);
        assert_true(sph_case_run(&c, 10, 100.0));
        assert_true(c.s->step.max_speed < 1e-11 * c.s->c0);
        assert_true(fabs(c.s->step.rho_max - 1.0) < 1e-12 && fabs(c.s->step.rho_min - 1.0) < 1e-12);
        DROP(c.s);
    }
}

TEST(mass_and_momentum_are_kept)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct sph_case c;
        double before[SUM_COUNT], after[SUM_COUNT];
        sph_case_set(&c, dim, dim == 2 ? 24 : 12);
        c.prm.noise = 0.15;
        sph_case_start(&c, NULL);
        sph_sums(c.s, before);
        assert_true(sph_case_run(&c, SANITIZED ? 5 : 20, 100.0));
        sph_sums(c.s, after);
        assert_true(fabs(after[SUM_MASS] / before[SUM_MASS] - 1.0) < 1e-12);
        for (int a = 0; a < dim; a++)
            assert_true(fabs(after[SUM_MOMENTUM + a] - before[SUM_MOMENTUM + a]) < 1e-12);
        DROP(c.s);
    }
}

/* Two that fly at each other, on either side of a rank's border: neither gets through the other,
 * and no momentum is made. */
TEST(particles_collide)
{
    struct sph_case c;
    const int left = 12 * 24 + 11, right = left + 1;
    double before[SUM_COUNT], after[SUM_COUNT], least = 1.0;
    sph_case_set(&c, 2, 24);
    c.run.scene.initial.field = FIELD_REST;
    struct sph *s = sph_case_start(&c, NULL);
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        const double side = s->p.id[i] == left ? -1.0 : s->p.id[i] == right ? 1.0 : 0.0;
        if (side != 0.0)
            y[0] = 0.5 + 0.2 * side * s->dx;
        y[2] -= 0.05 * side * s->c0 * y[5];
    }
    s->lists.ready = false;
    sph_sums(s, before);
    for (int k = 0; k < 30; k++) {
        assert_true(sph_case_run(&c, 1, 100.0));
        double *y = sph_case_gather(s, 24 * 24);
        least = fmin(least, (y[6 * right] - y[6 * left]) / s->dx);
        mem_free(y);
    }
    sph_sums(s, after);
    print_message("nearest: %.2g dx\n", least);
    assert_true(least > 0.05);
    for (int a = 0; a < 2; a++)
        assert_close(after[SUM_MOMENTUM + a], before[SUM_MOMENTUM + a], 1e-13 * s->c0);
    DROP(c.s);
}

TEST(steps_are_shared_out_evenly)
{
    struct sph_case c;
    sph_case_set(&c, 2, 24);
    sph_case_start(&c, NULL);
    const double most = c.s->step.dt_most, t_stop = 2.5 * most;
    assert_true(sph_case_run(&c, 1, t_stop));
    assert_true(fabs(c.s->dt - t_stop / 3.0) < 1e-3 * most);
    assert_true(sph_case_run(&c, 2, t_stop));
    assert_true(c.s->t == t_stop);
    DROP(c.s);
}

TEST(a_broken_state_is_found_and_placed)
{
    static const char *const reason[] = {"not finite", "particle", "density of a particle"};
    for (int kind = 0; kind < 3; kind++) {
        struct sph_case c;
        struct diagnosis d = {0};
        sph_case_set(&c, 2, 24);
        c.prm.density_limit = kind == 2 ? 0.02 : 0.1;
        sph_case_start(&c, NULL);
        for (int i = 0; i < c.s->p.n; i++)
            if (c.s->p.id[i] == 77) {
                double *y = c.s->p.y + (size_t)i * c.s->p.nstate;
                y[kind == 2 ? 5 : 2] *= kind == 0 ? NAN : kind == 1 ? 1e6 : 1.5;
            }
        integrate_step(c.s, 100.0, &d);
        assert_true(d.bad);
        assert_non_null(strstr(d.reason, reason[kind]));
        assert_true(strlen(d.where) > 0 && strlen(d.likely) > 0);
        DROP(c.s);
    }
}

/* Runs 8 steps, with rows in between if asked; saves after 4 and goes on from there if asked. */
static double *run_with(bool zones, bool rows, bool restart, int *n)
{
    double values[64];
    struct sph_case c;
    sph_case_set(&c, 2, SANITIZED ? 24 : 40);
    c.prm.noise = 0.1;
    if (zones) {
        c.run.scene.domain.max[0] = c.run.scene.domain.max[1] = 1.0;
        c.run.scene.domain.periodic[0] = c.run.scene.domain.periodic[1] = false;
        c.prm.outer = OUTER_EXACT;
    }
    sph_case_start(&c, NULL);
    for (int k = 0; k < 8; k++) {
        if (k == 4 && restart)
            sph_case_restart(&c);
        if (rows)
            VALUES_OF(sph_row, c.s, values);
        assert_true(sph_case_run(&c, 1, 100.0));
    }
    return sph_case_end_state(&c, n);
}

/* A level that takes several steps within one of the coarser level says after each what it shows:
 * speeds all of them, none the square of one. */
TEST(extremes_of_several_steps_are_speeds)
{
    struct sph_case c;
    sph_case_set(&c, 2, 16);
    sph_case_start(&c, NULL);
    double most[LEVELS][EXTREMES], once[EXTREMES];
    extremes_clear(most);
    extremes_of_lines(c.s, most[0]);
    memcpy(once, most[0], sizeof once);
    assert_true(once[MOST_RELATIVE] > 0.0 && once[MOST_RELATIVE] < 0.999);
    extremes_of_lines(c.s, most[0]);
    assert_memory_equal(once, most[0], sizeof once);
    DROP(c.s);
}

TEST(restart_and_rows_leave_no_trace)
{
    for (int zones = 0; zones <= 1; zones++) {
        int n[3];
        double *straight = run_with(zones, false, false, n);
        double *rows = run_with(zones, true, false, n + 1);
        double *again = run_with(zones, true, true, n + 2);
        assert_true(none_anywhere(n[0] != n[1] ||
                                  memcmp(straight, rows, (size_t)n[0] * sizeof(double)) != 0));
        assert_true(none_anywhere(n[0] != n[2] ||
                                  memcmp(straight, again, (size_t)n[0] * sizeof(double)) != 0));
        FREE(straight, rows, again);
    }
}
