/* test_regions_flow.c - regions that the flow asks for: near a surface, in vortices, at a pressure
 * peak; budget, and the same on any number of ranks. ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/neighbours.h"
#include "../../../sph/refinement/criteria.h"
#include "../../../sph/refinement/refinement.h"
#include "../../../sph/refinement/regions_parts.h"
#include "../../../sph/surface/surface.h"
#include "sph_case.h"

static void ask(int kind, double above, double distance, int levels, double budget)
{
    apr_given = (struct apr_params){.margin = 3.0, .around = 3, .particles = budget};
    apr_given.criteria.n = 1;
    apr_given.criteria.of[0] =
        (struct apr_criterion){.level = levels, .kind = kind, .above = above, .distance = distance};
}

static void ask_nothing(void) { apr_given = (struct apr_params){0}; }

/* Of all levels and ranks. */
static double particles(const struct sph *s, bool flowing)
{
    double n = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            n += !flowing || !particles_is_guard(&q->p, i);
    return ranks_sum(MPI_COMM_WORLD, n);
}

/* Whoever lies on the surface, and R of the coarser level around it, is in the region. */
TEST(the_surface_is_refined)
{
    struct sph_case c;
    sph_case_column(&c, 64)->domain.max[0] = 1.2;
    ask(CRITERION_SURFACE, 0.0, 1.0, 1, 0.0);
    apr_given.around = 2;
    struct sph *s = sph_case_start(&c, NULL);
    for (int turn = 0; turn < (SANITIZED ? 1 : 6); turn++) {
        assert_true(sph_case_run(&c, 10, 10.0));
        integrate_gradients(s);
        long outside = 0, seen = 0, fine = 0;
        for (const struct sph *q = s; q; q = q->finer)
            for (int i = 0; i < q->p.n; i++) {
                const double *y = state_row(&q->p, q->p.y, i);
                const bool flows = !particles_is_guard(&q->p, i);
                const bool on = flows && q->surface->is[i] == SURFACE_ON;
                seen += on;
                fine += q->level == 1 && flows;
                outside += on && regions_distance(s->refinement->regions, 1, y) < 1.5 * s->R;
            }
        MPI_Allreduce(MPI_IN_PLACE, &fine, 1, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
        assert_true(none_anywhere(outside));
        assert_true(max_anywhere((double)seen) > 0.0);
        assert_true(fine > 1024 && (double)fine < particles(s, true)); /* not the corner below */
    }
    DROP(c.s);
    ask_nothing();
}

/* Taylor-Green: the vortices are refined, their corners are not, and no step has more particles
 * than the budget. */
TEST(vortices_are_refined_within_the_budget)
{
    struct sph_case c;
    double last = INFINITY;
    for (int k = SANITIZED; k < 2; k++) {
        const double budget = k ? 14000.0 : 0.0;
        sph_case_set(&c, 2, 80);
        c.prm.R_dx = 3.0;
        c.run.scene.time.end = 1.0;
        ask(CRITERION_VORTICITY, 0.1, 0.0, 1, budget);
        apr_given.around = 2;
        struct sph *s = sph_case_start(&c, NULL);
        double most = 0.0;
        for (int step = 0; step < (SANITIZED ? 3 : 12); step++) {
            assert_true(sph_case_run(&c, 1, 1.0));
            most = fmax(most, particles(s, false));
        }
        assert_true(most > 6400.0 && most < last);
        assert_close(most, criteria_forecast(s->refinement->regions), 0.05 * most);
        if (budget > 0.0)
            assert_true(most <= budget);
        last = most;
        DROP(c.s);
    }
    ask_nothing();
}

/* On one rank alone and on all of them: the same cells after some steps of vortices that are
 * carried along. */
TEST(ranks_have_the_same_regions)
{
    if (is_alone())
        skip();
    struct sph_case both[2];
    for (int k = 0; k < 2; k++) {
        struct sph_case *c = both + k;
        sph_case_set(c, 2, 60);
        c->prm.R_dx = 3.0;
        c->run.scene.time.end = 1.0;
        if (k == 1) {
            c->run.comm = MPI_COMM_SELF;
            c->run.rank = 0;
            c->run.size = 1;
        }
        ask(CRITERION_VORTICITY, 0.15, 0.0, 1, 0.0);
        apr_given.around = 2;
        sph_case_start(c, NULL);
        assert_true(sph_case_run(c, 10, 1.0));
    }
    const struct marks *a = both[0].s->refinement->regions->level[1].cells,
                       *b = both[1].s->refinement->regions->level[1].cells;
    assert_true(none_anywhere(memcmp(a->mark, b->mark, marks_count(a)) != 0));
    const double n = particles(both[0].s, true), share = particles(both[1].s, true);
    assert_close(n, share / both[0].run.size, 0.0);
    for (int k = 0; k < 2; k++)
        DROP(both[k].s);
    ask_nothing();
}

/* Size of the gradient of p of a particle, or its largest jump of p with neighbours once both are
 * carried to the middle, over rho max(u^2, g dx)/dx or without dx; g = 1. */
static double indicator(const struct sph *s, int kind, double dx, int i)
{
    const double *q = prim_line(&s->p, i), *g = slope_line(&s->p, i), rho = q[at_rho(2)];
    const double c2 = s->c0 * s->c0 * pow(rho / s->rho0, 6.0);
    const double unit = rho * fmax(q[2] * q[2] + q[3] * q[3], dx);
    double most = 0.0;
    if (kind == CRITERION_PRESSURE)
        return c2 * hypot(g[0], g[1]) * dx / unit;
    for (int k = 0; k < s->list->count[i]; k++) {
        const int j = s->list->j[s->list->start[i] + k];
        const double *y = prim_line(&s->p, j), *h = slope_line(&s->p, j);
        const double d[2] = {y[0] - q[0], y[1] - q[1]};
        const double mid = 0.5 * ((g[0] + h[0]) * d[0] + (g[1] + h[1]) * d[1]);
        if (hypot(d[0], d[1]) < s->R && j < s->p.n + s->p.nhalo)
            most = fmax(most, c2 * fabs(y[at_rho(2)] - rho - mid) / unit);
    }
    return most;
}

/* Water at rest: the gradient is 1 in these units and nothing jumps, so a bound above refines
 * nothing below the surface, one below all of it by gradients and still nothing by jumps. */
TEST(still_water_is_refined_by_its_weight_alone)
{
    static const int kinds[3] = {CRITERION_PRESSURE, CRITERION_PRESSURE, CRITERION_JUMP};
    static const double bounds[3] = {2.0, 0.5, 0.5};
    for (int k = 0; k < 3; k++) {
        struct sph_case c;
        long in = 0, out = 0;
        sph_case_column(&c, 40)->domain.max[0] = 1.2;
        c.run.scene.shapes[0].box[1][0] = 1.2;
        ask(kinds[k], bounds[k], 0.0, 1, 0.0);
        apr_given.around = 2;
        struct sph *s = sph_case_start(&c, NULL);
        assert_true(sph_case_run(&c, SANITIZED ? 2 : 5, 10.0));
        for (int i = 0; i < s->p.n; i++) {
            const double *y = state_row(&s->p, s->p.y, i);
            const double d = regions_distance(s->refinement->regions, 1, y);
            in += y[1] < 0.1 && d > 0.0;
            out += y[1] < 0.1 && d < 0.0;
        }
        assert_true(max_anywhere((double)(in + out)) > 0.0);
        assert_true(none_anywhere(k == 1 ? out : in));
        DROP(c.s);
    }
    ask_nothing();
}

/* A column that falls: at its front all of the depth's pressure falls to nothing, and a wave of
 * release runs from there. Whoever is above the bound lies in the region. */
TEST(steep_pressures_are_refined)
{
    static const int kinds[2] = {CRITERION_PRESSURE, CRITERION_JUMP};
    static const double bounds[2] = {2.5, 0.5};
    for (int k = 0; k < 2; k++) {
        struct sph_case c;
        long above = 0, outside = 0;
        sph_case_column(&c, 48)->domain.max[0] = 1.2;
        ask(kinds[k], bounds[k], 0.0, 1, 0.0);
        apr_given.around = 2;
        struct sph *s = sph_case_start(&c, NULL);
        for (int turn = 0; turn < (SANITIZED ? 1 : 3); turn++) {
            assert_true(sph_case_run(&c, 10, 10.0));
            integrate_gradients(s);
            for (const struct sph *q = s; q; q = q->finer)
                for (int i = 0; i < q->p.n; i++) {
                    if (particles_is_guard(&q->p, i) ||
                        indicator(q, kinds[k], s->dx, i) <= bounds[k])
                        continue;
                    above++;
                    outside += regions_distance(s->refinement->regions, 1,
                                                state_row(&q->p, q->p.y, i)) < 0.0;
                }
        }
        assert_true(max_anywhere((double)above) > 0.0);
        assert_true(none_anywhere(outside));
        DROP(c.s);
    }
    ask_nothing();
}

/* A region that follows the peak goes to where the column's foot is. */
TEST(the_peak_takes_its_region_along)
{
    struct sph_case c;
    sph_case_column(&c, 32)->domain.max[0] = 1.2;
    apr_given = (struct apr_params){.margin = 3.0, .around = 3};
    apr_given.regions.n = 1;
    struct apr_region *is = apr_given.regions.of;
    *is = (struct apr_region){.level = 1, .min = {0.3, -0.1, 0.0}, .max = {0.75, 0.25, 0.0}};
    strcpy(is->follow, "peak");
    strcpy(is->along, "x");
    is->pressure = 100.0;
    struct sph *s = sph_case_start(&c, NULL);
    const struct regions *g = s->refinement->regions;
    double before = 0.0;
    for (int step = 0; step < 40; step++) {
        assert_true(sph_case_run(&c, 1, 10.0));
        const double shift = g->sets[0].shift[0];
        assert_true(fabs(shift - before) <= 0.5 * 0.5 * c.prm.dx * (1.0 + 1e-9));
        before = shift;
    }
    /* hydrostatic: the largest pressure is at the foot, near x = 0 and far from the front */
    assert_true(before < -0.1 && g->sets[0].shift[1] == 0.0);
    assert_true(particles(s, true) > 256.0);
    DROP(c.s);
    ask_nothing();
}
