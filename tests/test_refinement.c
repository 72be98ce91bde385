/* test_refinement.c - levels of refinement: what they must leave as it is.
 * ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "test.h"

#include "../sph/refinement/apr_params.h"
#include "../sph/refinement/refinement.h"
#include "sph_case.h"

/* A box of the finest level. */
static void refine(const struct sph_case *c, int levels, double from, double to)
{
    apr_given = (struct apr_params){.levels = levels, .margin = 3.0};
    apr_given.regions.n = 1;
    apr_given.regions.of[0].level = levels;
    for (int a = 0; a < c->run.scene.domain.dim; a++) {
        apr_given.regions.of[0].min[a] = from;
        apr_given.regions.of[0].max[a] = to;
    }
}

static void refine_nothing(void) { apr_given = (struct apr_params){0}; }

/* Particles of a level that flow, of all ranks. */
static double flowing(const struct sph *q)
{
    double n = 0.0;
    for (int i = 0; i < q->p.n; i++)
        n += !particles_is_guard(&q->p, i);
    MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_DOUBLE, MPI_SUM, q->run->comm);
    return n;
}

/* A lattice that is carried through the box once around: births and removals, and every guard gets
 * what is everywhere. */
static void translation_is_exact(void **state)
{
    (void)state;
    const double U[2] = {1.0, 0.0};
    struct sph_case c;
    sph_case_set(&c, 2, 20);
    c.run.scene.initial.field = FIELD_REST;
    c.run.scene.fluid.nu = 0.0;
    c.prm.noise = 0.0;
    refine(&c, 1, 0.1, 0.9);
    struct sph *s = sph_case_start(&c, NULL);
    assert_true(s->finer != NULL && s->finer->finer == NULL);
    for (struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            double *y = state_row(&q->p, q->p.y, i);
            for (int a = 0; a < 2; a++)
                y[2 + a] = y[5] * U[a];
        }
    integrate_start(s);
    const double n[2] = {flowing(s), flowing(s->finer)};
    while (s->t < 1.0)
        assert_true(sph_case_run(&c, 1, 1.0));
    double worst = 0.0;
    for (struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i);
            for (int a = 0; a < 2; a++)
                worst = fmax(worst, fabs(y[2 + a] / y[5] - U[a]));
            worst = fmax(worst, fabs(y[5] / y[4] - 1.0));
        }
    print_message("worst %g; %g %g -> %g %g\n", worst, n[0], n[1], flowing(s), flowing(s->finer));
    assert_true(max_anywhere(worst) < 1e-10);
    assert_true(flowing(s) == n[0] && flowing(s->finer) == n[1]);
    sph_free(&c.s);
    refine_nothing();
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(translation_is_exact)};
    MPI_Init(&argc, &argv);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    MPI_Finalize();
    return failed;
}
