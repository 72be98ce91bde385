/* test_sides.c - inlets and outlets: sound leaves through absorbing sides and comes back from
 * walls; a stream keeps its mass and its speed, and at an outlet its profile. ranks: 1 4.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/open_boundaries/sides.h"
#include "sph_case.h"

/* A square of 40 x 40 particles, periodic along y, with `kind' on both sides across x. */
static void channel(struct sph_case *c, enum wall_kind kind)
{
    sph_case_set(c, 2, 40);
    struct scene *e = &c->run.scene;
    e->fluid.nu = 0.0;
    e->initial.field = FIELD_REST;
    e->domain.periodic[0] = false;
    e->nwalls = 2;
    for (int k = 0; k < 2; k++) {
        e->walls[k].side = SIDE_X_MIN + k;
        e->walls[k].kind = kind;
    }
    if (kind == WALL_SLIP)
        return;
    c->prm.outer = OUTER_SIDES;
    e->coupling.transition = e->coupling.buffer = 5.0 / 40.0;
}

/* Largest |p|/(rho c0^2) over the middle. */
static double sound(const struct sph *s)
{
    double most = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = s->p.y + (size_t)i * s->p.nstate;
        if (fabs(y[0] - 0.5) < 0.25)
            most = fmax(most, fabs(eos_p(y[5] / y[4], s->rho0, s->c0, s->gamma)));
    }
    return max_anywhere(most) / (s->rho0 * s->c0 * s->c0);
}

/* What is left of a pulse of 1e-3 rho0 after its halves have met both sides and come back. */
static double echo(enum wall_kind kind)
{
    struct sph_case c;
    channel(&c, kind);
    c.prm.damper = 0.0;
    struct sph *s = sph_case_start(&c, NULL);
    for (int i = 0; i < s->p.n; i++) {
        double *y = s->p.y + (size_t)i * s->p.nstate;
        const double d = (y[0] - 0.5) / 0.08;
        y[4] = y[5] / (s->rho0 * (1.0 + 1e-3 * exp(-d * d)));
    }
    const double before = sound(s);
    assert_true(sph_case_run(&c, SANITIZED ? 20 : 200, 0.1)); /* L/c0 */
    const double after = sound(s);
    DROP(c.s);
    return after / before;
}

TEST(sound_leaves)
{
    const double wall = echo(WALL_SLIP), absorbing = echo(WALL_ABSORBING);
    print_message("left of a pulse: %.3f between walls, %.4f between absorbing sides\n", wall,
                  absorbing);
    assert_true(wall > 0.5);
    assert_true(SANITIZED || absorbing < 0.05);
}

TEST(streams_keep_their_mass)
{
    struct sph_case c;
    double sums[SUM_COUNT];
    if (SANITIZED)
        skip();
    channel(&c, WALL_INFLOW);
    c.run.scene.walls[0].velocity[0] = 1.0;
    c.run.scene.walls[1].kind = WALL_OUTFLOW;
    c.run.scene.initial.field = FIELD_UNIFORM;
    c.run.scene.initial.velocity[0] = 1.0;
    struct sph *s = sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, 150, 0.3));
    sph_sums(s, sums);
    print_message("mass %.4f, speed %.4f\n", sums[SUM_MASS] / s->start.mass,
                  sums[SUM_MOMENTUM] / sums[SUM_MASS]);
    assert_close(sums[SUM_MASS] / s->start.mass, 1.0, 0.03);
    assert_close(sums[SUM_MOMENTUM] / sums[SUM_MASS], 1.0, 0.01);
    DROP(c.s);
}

/* u_x of a stream along x, polynomials across it: 1 is that of the test, 2 also curved. */
static double profile_at(const double *x, int degree)
{
    const double y = x[1] - 0.5, z = x[2] - 0.5;
    return 1.0 + 0.8 * y - 0.5 * z + (degree > 1 ? -2.0 * y * y + 0.7 * y * z - 1.2 * z * z : 0.0);
}

/* Largest error of what the outlet of a 3D channel between walls, its particles displaced by up to
 * a quarter of dx, takes from inside, over the side's whole width. */
static double outlet_error(int degree)
{
    enum { CELLS = 12 };
    struct sph_case c;
    double most = 0.0;
    sph_case_set(&c, 3, CELLS);
    struct scene *e = &c.run.scene;
    e->domain.max[0] = 2.0;
    e->initial.field = FIELD_REST;
    for (int side = 0; side < 6; side++)
        e->walls[side] = (struct scene_wall){.side = SIDE_X_MIN + side, .kind = WALL_NO_SLIP};
    e->walls[0].kind = WALL_INFLOW;
    e->walls[1].kind = WALL_OUTFLOW;
    e->walls[0].velocity[0] = 1.0;
    e->nwalls = 6;
    memset(e->domain.periodic, 0, sizeof e->domain.periodic);
    c.prm.outer = OUTER_SIDES;
    e->coupling.transition = e->coupling.buffer = 5.0 / CELLS;
    struct sph *s = sph_case_start(&c, NULL);
    for (int i = 0; i < s->p.n; i++) {
        double *y = s->p.y + (size_t)i * s->p.nstate;
        for (int a = 1; a < 3; a++) /* the same on any number of ranks */
            y[a] += 0.25 * s->dx * sin(1e3 * (y[0] + 2.0 * y[1] + 3.0 * y[2]) + a);
        y[3] = y[at_mass(3)] * profile_at(y, degree);
    }
    s->zones->update(s);
    for (int k = 0; k < 400; k++) {
        const double x[3] = {1.95, (k % 20 + 0.5) / 20.0, (k / 20 + 0.5) / 20.0};
        double u[3], p;
        s->zones->eval(s->zones->ctx, 0.0, 1, x, u, &p, NULL, NULL);
        most = fmax(most, fabs(u[0] - profile_at(x, degree)));
    }
    DROP(c.s);
    return max_anywhere(most);
}

/* Means of bins had the error of half a bin at walls, 0.1 here, and gave the row beside a no-slip
 * wall twice its speed: a duct's particles then passed its walls. */
TEST(outlets_keep_the_profile)
{
    const double plane = outlet_error(1), curved = outlet_error(2);
    print_message("outlet: error of a plane profile %.2g, of a curved one %.2g\n", plane, curved);
    assert_true(plane < 0.005);
    assert_true(curved < 2.0 * 2.0 / 144.0); /* u'' dx^2/2 */
}

/* Pa: pressures of the outlet of a channel, 0 there, whose water runs out at 1 m/s in its upper
 * half and with `below' m/s along x in its lower one; deep in each, p[0] above, p[1] below. */
static void outlet_pressures(double below, double p[2])
{
    struct sph_case c;
    channel(&c, WALL_INFLOW);
    c.run.scene.walls[0].velocity[0] = 1.0;
    c.run.scene.walls[1].kind = WALL_OUTFLOW;
    struct sph *s = sph_case_start(&c, NULL);
    for (int i = 0; i < s->p.n; i++) {
        double *y = s->p.y + (size_t)i * s->p.nstate;
        y[2] = y[at_mass(2)] * (y[1] > 0.5 ? 1.0 : below);
    }
    s->zones->update(s);
    for (int k = 0; k < 2; k++) {
        const double x[3] = {0.99, k ? 0.25 : 0.75, 0.0};
        double u[3];
        s->zones->eval(s->zones->ctx, 0.0, 1, x, u, p + k, NULL, NULL);
        p[k] /= s->rho0;
    }
    DROP(c.s);
}

/* Water at rest outside has no more head than its pressure; what runs in through the whole side is
 * driven by the pressure that is given. (Before, an eddy in an outlet had the given pressure and
 * its velocity, too, and grew without end.) */
TEST(eddies_bring_no_head_through_outlets)
{
    double p[2];
    outlet_pressures(-0.01, p);
    assert_close(p[0], 0.0, 1e-6);
    assert_true(p[1] + 0.5 * 1e-4 < 0.02 * 0.5 * 1e-4);
    outlet_pressures(0.5, p);
    assert_close(p[1], 0.0, 1e-6);
    outlet_pressures(-0.5, p);
    assert_close(p[0], 0.0, 1e-6);
    assert_close(p[1], -0.5 * 0.25 / 1.5, 1e-3); /* two thirds of the flow leave */
}
