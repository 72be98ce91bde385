/* test_surface_growth.c - tiny waves on water do not grow, wherever the surface stands between the
 * rows of cells, nor where rows and gravity are at an angle. ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/surface/levelset.h"
#include "fv_case.h"

static struct fv *start(struct fv_case *c, const char *const *overrides,
                        const struct scene_shape *shape)
{
    fv_case_set(c, MPI_COMM_WORLD, overrides);
    fv_case_close(c, WALL_SLIP);
    if (shape)
        c->run.scene.shapes[c->run.scene.nshapes++] = *shape;
    return fv_case_start(c, NULL);
}

/* Largest kinetic energy from now to time t. */
static double oscillation(struct fv_case *c, double t)
{
    double most = 0.0;
    while (c->s->t < t) {
        assert_true(fv_case_run(c, 1, t));
        most = fmax(most, surface_energy(c->s));
    }
    return most;
}

/* A standing wave of n cells, its surface theta above the centres of a row: energy of its last
 * second over that of its first. */
static double grows(int n, double theta, const char *integrator)
{
    const double h = 0.035;
    struct fv_case c;
    char cells[48], size[64], length[48], level[48];
    snprintf(cells, sizeof cells, "fv.cells=(%d,20)", n);
    snprintf(size, sizeof size, "domain.max=(%.17g,0.7)", n * h);
    snprintf(length, sizeof length, "initial.L=%.17g", n * h);
    snprintf(level, sizeof level, "initial.level=%.17g", (15.5 + theta) * h);
    start(&c,
          (const char *const[]){"fv.surface=\"yes\"", "initial.field=\"standing_wave\"",
                                "initial.U=0.001", "initial.amplitude=1e-5",
                                "domain.periodic=(true,false)", "fluid.gravity=(0,-9.81)",
                                "fluid.nu=0", integrator, cells, size, length, level, NULL},
          NULL);
    const double first = oscillation(&c, 1.0);
    oscillation(&c, 3.0);
    const double last = oscillation(&c, 4.0);
    print_message("%d cells, theta %.2f, %s: %.3g\n", n, theta, integrator, last / first);
    fv_free(&c.s);
    return last / first;
}

TEST_ALONE(waves_of_a_few_cells_do_not_grow)
{
    static const double theta[] = {0.02, 0.13, 0.36, 0.64, 0.93};
    for (int k = 0; k < 5; k += SANITIZED || !is_alone() ? 5 : 1) {
        assert_true(grows(6, theta[k], "fv.integrator=\"rk3\"") < 3.0); /* 50 by mean slopes */
        assert_true(grows(12, theta[k], "fv.integrator=\"rk3\"") < 1.1);
    }
    assert_true(SANITIZED || grows(6, 0.2, "fv.integrator=\"newton\"") < 1.1);
    assert_true(grows(12, 0.4, "fv.integrator=\"newton\"") < 1.1);
}

/* Gravity at an angle to the cells, and a surface that is not quite level. */
TEST_ALONE(water_rests_in_tanks_that_lean)
{
    static const double degrees[] = {10.6, -22.7, -70.9};
    for (int k = 0; k < 3; k++) {
        const double angle = degrees[k] * M_PI / 180.0;
        const struct scene_shape shape = {.form = SHAPE_BELOW, .level = 0.1};
        struct fv_case c;
        char gravity[80];
        snprintf(gravity, sizeof gravity, "fluid.gravity=(%.17g,%.17g)", 9.81 * sin(angle),
                 -9.81 * cos(angle));
        struct fv *s =
            start(&c,
                  (const char *const[]){"fv.surface=\"yes\"", "initial.field=\"rest\"",
                                        "domain.periodic=(false,false)", gravity, "fluid.nu=0",
                                        "domain.min=(-0.5,-0.4)", "domain.max=(0.5,0.4)",
                                        "fv.cells=(25,20)", NULL},
                  &shape);
        double x[3], first = 0.0, last = 0.0;
        BLOCK_CELLS (&s->b, i, j, layer, at) {
            block_centre(&s->b, i, j, layer, x);
            s->surface->phi[at] += 4e-5 * cos(9.0 * (x[0] * cos(angle) + x[1] * sin(angle)));
        }
        surface_ghosts(s, s->surface->phi);
        for (int n = 0; n < (SANITIZED || !is_alone() ? 40 : 400); n++) {
            assert_true(fv_case_run(&c, 1, 100.0));
            double *most = n < 100 ? &first : &last;
            *most = fmax(*most, surface_energy(s));
        }
        print_message("leaning by %.1f degrees: energy %.3g, then %.3g\n", degrees[k], first, last);
        assert_true(SANITIZED || !is_alone() || last < 4.0 * first);
        fv_free(&c.s);
    }
}
