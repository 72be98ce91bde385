/* test_sph_watch.c - energy is watched against its budget: gains of an unstable step end the run, a
 * driven flow and a moving wall gain nothing; forces are compared at rest; the worst particle is
 * named alike on any number of ranks; impacts are no faults; shifting knows neither initial.U nor
 * what carries the flow. ranks: 1 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "sph_restart.h"

static double gain_of(const struct sph_case *c) { return c->s->watch.of[SPH_WATCH_ENERGY].worst; }

TEST(a_sound_flow_gains_nothing)
{
    struct sph_case c;
    sph_case_set(&c, 2, 24);
    sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, SANITIZED ? 30 : 120, 100.0));
    assert_true(gain_of(&c) < 1e-3);
    DROP(c.s);
}

/* Beyond the bound of the Riemann schemes; strict bounds hold the densities meanwhile. */
TEST(an_unstable_step_is_ended_by_its_energy)
{
    struct sph_case c;
    struct diagnosis d = {0};
    if (SANITIZED)
        return;
    sph_case_set(&c, 2, 24);
    c.prm.cfl = 0.85;
    c.prm.limiter = LIMITER_MINMOD;
    c.prm.density_limit = 0.0;
    sph_case_start(&c, NULL);
    for (int k = 0; k < 400 && !d.bad; k++) {
        integrate_step(c.s, 100.0, &d);
        c.run.step++;
    }
    assert_true(d.bad);
    assert_non_null(strstr(d.reason, "energy"));
    assert_true(c.s->total.max_mach < 0.5); /* long before the speeds say so */
    DROP(c.s);
}

/* A channel along x between no-slip walls; the upper one at U, or a force. */
static void channel(struct sph_case *c, double U, double force)
{
    sph_case_set(c, 2, 20);
    struct scene *e = &c->run.scene;
    e->initial.field = FIELD_REST;
    e->domain.periodic[1] = false;
    e->fluid.nu = 0.05;
    e->fluid.gravity[0] = force;
    e->time.end = 10.0;
    e->nwalls = 2;
    e->walls[0] = (struct scene_wall){.side = SIDE_Y_MIN, .kind = WALL_NO_SLIP};
    e->walls[1] = (struct scene_wall){.side = SIDE_Y_MAX, .kind = WALL_NO_SLIP, .velocity = {U}};
    c->prm.walls = WALLS_NFM;
    c->prm.cfl_viscous = 0.025;
}

TEST(work_from_outside_is_no_gain)
{
    for (int k = 0; k < 2; k++) {
        struct sph_case c;
        double sums[SUM_COUNT];
        channel(&c, k ? 1.0 : 0.0, k ? 0.0 : 0.4);
        sph_case_start(&c, NULL);
        assert_true(c.s->watch.budget_closed);
        assert_true(sph_case_run(&c, SANITIZED ? 30 : 150, 100.0));
        sph_sums(c.s, sums);
        const double U = c.s->watch.reference;
        print_message("kinetic energy %.3g of M U^2, gain %.2g\n",
                      sums[SUM_KINETIC] / (c.s->start.mass * U * U), gain_of(&c));
        assert_true(SANITIZED ||
                    sums[SUM_KINETIC] > 0.01 * c.s->start.mass * U * U); /* 20 % of the scale */
        assert_true(gain_of(&c) < 0.01);
        DROP(c.s);
    }
}

/* Two faults, on different ranks where there are some: the worse is named, by its place. */
TEST(the_worst_particle_is_named)
{
    static const double factor[2] = {3.0, 5.0};
    for (int worse = 0; worse < 2; worse++) {
        struct sph_case c;
        struct diagnosis d = {0};
        sph_case_set(&c, 2, 24);
        c.prm.noise = 0.01;
        sph_case_start(&c, NULL);
        for (int i = 0; i < c.s->p.n; i++)
            for (int k = 0; k < 2; k++)
                if (c.s->p.id[i] == (k ? 24 * 20 + 20 : 24 * 3 + 3)) /* of 24 x 24 */
                    c.s->p.y[(size_t)c.s->p.nstate * i + 5] *= factor[k == worse];
        sph_fault_diagnose(c.s, &d);
        double x = -1.0, y = -1.0;
        assert_true(d.bad);
        assert_int_equal(sscanf(d.where, "(%lf, %lf) m", &x, &y), 2);
        assert_close(x, worse ? 20.5 / 24.0 : 3.5 / 24.0, 1e-2);
        assert_close(y, worse ? 20.5 / 24.0 : 3.5 / 24.0, 1e-2);
        assert_null(strstr(d.where, "rank"));
        DROP(c.s);
    }
}

/* A square at Mach 0.1 into a wall: compressed by a tenth, as rho c U wants it, and no fault. */
TEST(an_impact_is_no_fault)
{
    struct sph_case c;
    sph_case_set(&c, 2, 24);
    struct scene *e = &c.run.scene;
    e->fluid.nu = 0.0;
    e->initial.field = FIELD_REST;
    e->domain.periodic[0] = e->domain.periodic[1] = false;
    e->nwalls = 2;
    e->walls[0].side = SIDE_X_MIN;
    e->walls[1].side = SIDE_Y_MIN;
    e->nshapes = 1;
    e->shapes[0].box[1][0] = e->shapes[0].box[1][1] = 0.5;
    e->shapes[0].velocity[0] = e->shapes[0].velocity[1] = -1.0;
    c.prm.surface = SURFACE_YES;
    c.prm.scheme = SCHEME_RIEMANN;
    c.prm.walls = WALLS_NFM;
    c.prm.c0 = 14.0;
    c.prm.density_limit = 0.0;
    sph_case_start(&c, NULL);
    double most = 0.0;
    for (int k = 0; k < 40; k++) {
        assert_true(sph_case_run(&c, 1, 100.0));
        most = fmax(most, c.s->step.rho_max / c.s->rho0 - 1.0);
    }
    print_message("compressed by %.3g\n", most);
    assert_true(most > 0.07);
    DROP(c.s);
}

static double shift_speed(enum initial_field field, double U, double V)
{
    struct sph_case c;
    sph_case_set(&c, 2, 24);
    c.run.scene.initial.field = field;
    c.run.scene.initial.U = U;
    c.run.scene.initial.velocity[0] = V;
    c.prm.c0 = 30.0;
    sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, 3, 100.0));
    const double speed = c.s->step.shift_speed;
    DROP(c.s);
    return speed;
}

TEST(shifting_has_the_scale_of_the_flow)
{
    assert_close(shift_speed(FIELD_TAYLOR_GREEN, 1.0, 0.0), 1.0, 0.02);
    assert_close(shift_speed(FIELD_TAYLOR_GREEN, 1.0, 2.0), 1.0, 0.02);
    assert_close(shift_speed(FIELD_UNIFORM, 5.0, 2.0), 0.0, 1e-9);
}

/* Worst values, budget and work after a restart are those of a run in one piece. */
TEST(a_restart_judges_as_one_run)
{
    struct sph_watch after[2];
    for (int restart = 0; restart < 2; restart++) {
        struct sph_case c;
        channel(&c, 0.0, 0.4);
        sph_case_start(&c, NULL);
        assert_true(sph_case_run(&c, 35, 100.0));
        if (restart)
            sph_case_restart(&c);
        assert_true(sph_case_run(&c, 30, 100.0));
        after[restart] = c.s->watch;
        DROP(c.s);
    }
    assert_true(after[0].work == after[1].work);
    assert_int_equal(after[0].budget.n, after[1].budget.n);
    for (int k = 0; k < after[0].budget.n; k++)
        assert_true(after[0].budget.least[k] == after[1].budget.least[k]);
    for (int k = 0; k < SPH_WATCHES; k++)
        assert_true(after[0].of[k].worst == after[1].of[k].worst);
}

/* A square at rest in a tank at rest; what the fluid loses to it is said to be more by a tenth of
 * the pressure on its faces than it is. */
TEST(forces_are_compared_at_rest)
{
    for (int wrong = 0; wrong < 3; wrong++) { /* the third moves */
        struct sph_case c;
        struct diagnosis d = {0};
        double pushed, pressure;
        struct scene *e = sph_case_tank(&c, 20, 1.0, 4);
        const double square[4][2] = {{0.4, 0.4}, {0.4, 0.6}, {0.6, 0.6}, {0.6, 0.4}};
        e->time.end = 10.0;
        e->nbodies = 1;
        e->bodies[0].points.n = 4;
        memcpy(e->bodies[0].points.x, square, sizeof square);
        c.prm.walls = WALLS_NFM;
        sph_case_start(&c, NULL);
        struct watch *w = c.s->watch.of + SPH_WATCH_FORCES;
        assert_true(sph_case_run(&c, 5, 100.0));
        body_average_pushed(c.s, 0, &pushed, &pressure);
        c.s->walls->speed = wrong == 2 ? 1.0 : 0.0;
        for (int k = 0; k < 24; k++) {
            struct force *f = c.s->walls->forces.now;
            f->F[0] = wrong ? 0.1 * pushed : 0.0;
            f->F[1] = body_average(c.s, 0).F[1];
            sph_watch_rest_forces(c.s, c.s->t, &d);
        }
        assert_false(d.bad);
        assert_int_equal(w->warned, wrong == 1);
        if (wrong == 1)
            assert_close(w->worst, 0.1, 0.005);
        DROP(c.s);
    }
}
