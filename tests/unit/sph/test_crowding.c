/* test_crowding.c - particles of a refined flow that overlap are counted, and the place is told.
 * ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/refinement/refinement.h"
#include "sph_case.h"

/* Still water without weight, periodic, half of it at half the spacing. */
static struct sph *start(struct sph_case *c)
{
    sph_case_set(c, 2, 40);
    c->run.scene.initial.field = FIELD_REST;
    c->run.scene.fluid.nu = 0.0;
    apr_given = (struct apr_params){.levels = 1, .margin = 3.0};
    apr_given.regions.n = 1;
    apr_given.regions.of[0].level = 1;
    for (int a = 0; a < 2; a++) {
        apr_given.regions.of[0].min[a] = a ? -1.0 : 0.1;
        apr_given.regions.of[0].max[a] = a ? 2.0 : 0.9;
    }
    sph_case_start(c, NULL);
    integrate_gradients(c->s);
    return c->s;
}

static double share(const struct sph *s)
{
    const struct sph_crowd c = sph_watch_crowd(s);
    double sums[2] = {c.crowded, c.counted};
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return sums[0] / sums[1];
}

/* Volumes of the fine level within r of the middle are `factor' times what there is room for. */
static double swell(struct sph *s, double r, double factor)
{
    double n[2] = {0.0, 0.0};
    for (struct sph *q = s; q; q = q->finer) {
        q->lists.ready = q->lists.sloped = false;
        for (int i = 0; i < q->p.n; i++) {
            double *y = state_row(&q->p, q->p.y, i);
            const bool in = q->coarser && hypot(y[0] - 0.5, y[1] - 0.5) < r;
            n[0] += in;
            n[1] += !(q->p.role[i] & ROLE_DEEP);
            for (int k = 2; in && k < q->p.nstate; k++)
                y[k] *= factor;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, n, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    integrate_gradients(s);
    return n[0] / n[1];
}

/* Twice as much as fits: those within are too many up to some spacings beside the rim, where the
 * sum is halfway between 2 and 1; an eighth too much is not. */
TEST(overlap_is_counted_and_placed)
{
    struct sph_case c;
    struct sph *s = start(&c);
    char text[256];
    assert_close(share(s), 0.0, 0.0);
    swell(s, 0.2, 1.125);
    assert_close(share(s), 0.0, 0.0);
    const double part = swell(s, 0.2, 2.0 / 1.125);
    assert_close(share(s), part, 0.25 * part);
    s->watch.crowd = sph_watch_crowd(s);
    sph_watch_say_crowd(s, text, sizeof text);
    double most, x, y;
    int level;
    assert_int_equal(sscanf(text, "%lf at (%lf, %lf) m, level %d", &most, &x, &y, &level), 4);
    assert_close(most, 2.0, 0.05);
    assert_true(hypot(x - 0.5, y - 0.5) < 0.2 && level == 1);
    DROP(c.s);
    apr_given = (struct apr_params){0};
}
