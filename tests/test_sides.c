/* test_sides.c - inlets and outlets: sound leaves through absorbing sides and comes back from
 * walls; a stream keeps its mass and its speed. ranks: 1 2 4. SPDX-License-Identifier: BSD-3-Clause
 */
#include "test.h"

#include "../sph/particles/eos.h"
#include "../sph/open_boundaries/sides.h"
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
    assert_true(sph_case_run(&c, 200, 0.1)); /* L/c0 */
    const double after = sound(s);
    sph_free(&c.s);
    return after / before;
}

static void sound_leaves(void **state)
{
    (void)state;
    const double wall = echo(WALL_SLIP), absorbing = echo(WALL_ABSORBING);
    print_message("left of a pulse: %.3f between walls, %.4f between absorbing sides\n", wall,
                  absorbing);
    assert_true(wall > 0.5);
    assert_true(absorbing < 0.05);
}

static void streams_keep_their_mass(void **state)
{
    struct sph_case c;
    double sums[SUM_COUNT];
    (void)state;
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
    print_message("mass %.4f, speed %.4f\n", sums[SUM_MASS] / s->mass0,
                  sums[SUM_MOMENTUM] / sums[SUM_MASS]);
    assert_close(sums[SUM_MASS] / s->mass0, 1.0, 0.03);
    assert_close(sums[SUM_MOMENTUM] / sums[SUM_MASS], 1.0, 0.01);
    sph_free(&c.s);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sound_leaves),
                                       cmocka_unit_test(streams_keep_their_mass)};
    MPI_Init(&argc, &argv);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    MPI_Finalize();
    return failed;
}
