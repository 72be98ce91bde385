/* test_criteria.c - cells that the flow marks: distances against brute force, nesting, hysteresis,
 * budget, the same on any number of ranks, restart. ranks: 1 4.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <unistd.h>

#include "../../../sph/refinement/criteria.h"
#include "../../../sph/refinement/regions.h"
#include "../../../sph/refinement/regions_parts.h"
#include "sph_case.h"

/* --- marks --- */

/* Distance of x from the nearest cell whose mark differs; cells beyond the ends as marks.h has it.
 */
static double brute(const struct marks *c, const double *x)
{
    const size_t home = marks_find(c, x);
    const bool in = c->mark[home];
    double best = INFINITY;
    for (int k = (c->dim == 3 ? -3 : 0); k < (c->dim == 3 ? c->n[2] + 3 : 1); k++)
        for (int j = -3; j < c->n[1] + 3; j++)
            for (int i = -3; i < c->n[0] + 3; i++) {
                const int at[3] = {i, j, k};
                double middle[3] = {0.0, 0.0, 0.0}, d = 0.0;
                bool beyond_open = false;
                for (int a = 0; a < c->dim; a++) {
                    const double lo = c->lo[a] + at[a] * c->h[a];
                    const double e = fmax(fmax(lo - x[a], x[a] - lo - c->h[a]), 0.0);
                    const bool low = at[a] < 0 && !c->periodic[a];
                    const bool high = at[a] >= c->n[a] && !c->periodic[a];
                    d += e * e;
                    beyond_open =
                        beyond_open || (low && c->open[2 * a]) || (high && c->open[2 * a + 1]);
                    int b = at[a];
                    if (c->periodic[a])
                        b = (b + c->n[a]) % c->n[a];
                    b = b < 0 ? 0 : b >= c->n[a] ? c->n[a] - 1 : b;
                    middle[a] = c->lo[a] + (b + 0.5) * c->h[a];
                }
                const bool mark = !beyond_open && c->mark[marks_find(c, middle)];
                if (mark != in)
                    best = fmin(best, d);
            }
    return in ? sqrt(best) : -sqrt(best);
}

static void distances_from(int dim, const bool *periodic, const bool *open, int points)
{
    struct marks c;
    const double lo[3] = {-0.5, 0.0, 0.1}, hi[3] = {0.5, 1.3, 0.8};
    assert_true(marks_create(NULL, &c, dim, lo, hi, periodic, open, 0.1, 1e6));
    const double h = fmin(fmin(c.h[0], c.h[1]), dim == 3 ? c.h[2] : 1.0);
    assert_true(h >= 0.1 * (1.0 - 1e-9));
    for (int turn = 0; turn < 6; turn++) {
        memset(c.mark, 0, marks_count(&c));
        for (int k = 0; k < 3 + 4 * turn; k++)
            c.mark[(size_t)rand() % marks_count(&c)] = 1;
        marks_dilate(&c, c.mark, turn % 4);
        marks_measure(&c);
        for (int p = 0; p < points; p++) {
            double x[3];
            for (int a = 0; a < 3; a++)
                x[a] = random_in(lo[a], hi[a]);
            const double d = marks_distance(&c, x), e = brute(&c, x);
            assert_true((d > 0.0) == (e > 0.0));
            const double exact = e > 0.0 ? 2.0 * h : h;
            if (fabs(e) < exact)
                assert_close(d, e, 1e-12);
            else
                assert_true(fabs(d) <= fabs(e) + 1e-12 && fabs(d) >= exact * (1.0 - 1e-12));
        }
    }
    FREE(c.mark, c.depth);
}

TEST(distance_to_marked_cells_is_exact_near_their_edge)
{
    const bool none[6] = {false}, some[6] = {true, false, false, true, true, true};
    srand(5);
    distances_from(2, none, none, 300);
    distances_from(2, (const bool[]){true, false, false}, some, 300);
    distances_from(3, none, none, 40);
    distances_from(3, (const bool[]){false, true, false}, some, 40);
}

/* --- criteria --- */

static struct regions *start(struct sph_case *c, int dim, int levels, double budget)
{
    sph_case_set(c, dim, dim == 2 ? 80 : 24);
    memcpy(c->prm.box[0], c->run.scene.domain.min, sizeof c->prm.box[0]);
    memcpy(c->prm.box[1], c->run.scene.domain.max, sizeof c->prm.box[1]);
    apr_given = (struct apr_params){.margin = 3.0, .around = 3, .particles = budget};
    apr_given.criteria.n = 1;
    apr_given.criteria.of[0] =
        (struct apr_criterion){.level = levels, .kind = CRITERION_VORTICITY, .above = 0.1};
    return regions_create(&c->run, &c->prm);
}

/* A vortex of size a at `at': each rank adds the lattice places whose turn it is. */
static void evaluate(struct regions *g, const double *at, double strength, double t)
{
    const int n = (int)lround(1.0 / g->dx), ranks = g->run->size;
    criteria_begin(g, 1.0, 0.0);
    for (int64_t i = g->run->rank; i < (int64_t)pow(n, g->dim); i += ranks) {
        const double x[3] = {((double)(i % n) + 0.5) * g->dx, ((double)(i / n % n) + 0.5) * g->dx,
                             g->dim == 3 ? ((double)(i / n / n) + 0.5) * g->dx : 0.0};
        double r2 = 0.0;
        for (int a = 0; a < g->dim; a++)
            r2 += pow(x[a] - at[a], 2.0);
        const struct flow_sample s = {
            .volume = pow(g->dx, g->dim), .rho = 1.0, .curl = strength * exp(-r2 / 0.01) / g->dx};
        criteria_add(g, x, &s);
    }
    criteria_end(g, t, 10.0);
}

static int marked(const struct regions *g, int level)
{
    int sum = 0;
    for (size_t k = 0; k < marks_count(g->level[level].cells); k++)
        sum += g->level[level].cells->mark[k];
    return sum;
}

TEST(vorticity_is_refined_with_all_levels_around)
{
    struct sph_case c;
    for (int dim = 2; dim <= 3; dim++) {
        struct regions *g = start(&c, dim, dim == 2 ? 3 : 2, 0.0);
        const int levels = regions_levels(g);
        const double at[3] = {0.55, 0.4, 0.5};
        assert_true(criteria_due(g, 0.0));
        assert_true(regions_distance(g, 1, at) == -INFINITY);
        evaluate(g, at, 1.0, 0.0);
        assert_false(criteria_due(g, 0.0));
        assert_true(criteria_due(g, 0.5 * regions_R(g, levels - 1) / 10.0));
        srand(6);
        long wrong = 0, fine = 0;
        for (int k = 0; k < 4000; k++) {
            const double x[3] = {random_in(0, 1), random_in(0, 1),
                                 dim == 3 ? random_in(0, 1) : 0.0};
            double r2 = 0.0;
            for (int a = 0; a < dim; a++)
                r2 += pow(x[a] - at[a], 2.0);
            for (int n = 1; n <= levels; n++) {
                const double e = exp(-r2 / 0.01) * ldexp(1.0, 1 - n); /* dx of the level below */
                const double d = regions_distance(g, n, x);
                /* a particle of the lattice, up to 0.7 dx off, may see a little less */
                wrong += e > 0.13 && d < 2.0 * regions_R(g, n - 1);
                wrong +=
                    n > 1 && d > 0.0 && regions_distance(g, n - 1, x) < 2.0 * regions_R(g, n - 2);
                fine += n == levels && d > 0.0;
            }
        }
        assert_true(wrong == 0 && fine > 0);
        assert_true(regions_distance(g, 1, (const double[]){0.05, 0.9, 0.05}) < 0.0 || dim == 3);
        DROP(g);
    }
}

/* Above the bound it is made, above a third of it it stays; below it goes, but not before its
 * time. */
TEST(cells_stay_for_a_while)
{
    struct sph_case c;
    struct regions *g = start(&c, 2, 1, 0.0);
    const double at[3] = {0.5, 0.5, 0.0}, life = 20.0 * regions_R(g, 0) / 10.0;
    evaluate(g, at, 0.09, 0.0);
    assert_int_equal(marked(g, 1), 0);
    evaluate(g, at, 0.11, 0.0);
    const int first = marked(g, 1);
    assert_true(first > 0);
    evaluate(g, at, 0.05, 2.0 * life);
    assert_int_equal(marked(g, 1), first);
    evaluate(g, at, 0.11, 3.0 * life);
    evaluate(g, at, 0.01, 3.9 * life);
    assert_int_equal(marked(g, 1), first);
    evaluate(g, at, 0.01, 4.1 * life);
    assert_int_equal(marked(g, 1), 0);
    DROP(g);
}

/* Particles if every place of the lattice has all that its levels ask for. */
static double count(const struct regions *g)
{
    const int n = (int)lround(1.0 / g->dx) * 4;
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const double x[3] = {(i + 0.5) / n, (j + 0.5) / n, 0.0};
            sum += 1.0 / 16.0;
            for (int l = 1; l <= regions_levels(g); l++)
                sum += regions_distance(g, l, x) > 0.0 ? pow(4.0, l) / 16.0 : 0.0;
        }
    return sum;
}

TEST(the_budget_is_kept)
{
    struct sph_case c;
    const double at[3] = {0.5, 0.5, 0.0};
    struct regions *g = start(&c, 2, 2, 0.0);
    evaluate(g, at, 1.0, 0.0);
    const double free = count(g);
    assert_close(criteria_forecast(g), free, 0.02 * free);
    DROP(g);
    double last = free;
    for (int k = 1; k <= 4; k++) {
        const double budget = 6400.0 + (free - 6400.0) * (1.0 - 0.2 * k);
        g = start(&c, 2, 2, budget);
        evaluate(g, at, 1.0, 0.0);
        assert_true(count(g) <= budget && count(g) > 6400.0 && count(g) < last);
        assert_true(criteria_factor(g) > 1.0);
        last = count(g);
        /* cells that would have to stay give way, too */
        evaluate(g, (const double[]){0.2, 0.7, 0.0}, 1.0, 0.01);
        assert_true(count(g) <= budget && count(g) > 6400.0);
        DROP(g);
    }
}

TEST(open_sides_are_left_alone)
{
    struct sph_case c;
    const double at[3] = {0.9, 0.5, 0.0};
    sph_case_set(&c, 2, 80);
    c.run.scene.domain.periodic[0] = false;
    c.run.scene.walls[0] = (struct scene_wall){.side = SIDE_X_MAX, .kind = WALL_OUTFLOW};
    c.run.scene.nwalls = 1;
    memcpy(c.prm.box[0], c.run.scene.domain.min, sizeof c.prm.box[0]);
    memcpy(c.prm.box[1], c.run.scene.domain.max, sizeof c.prm.box[1]);
    c.prm.outer = OUTER_SIDES;
    apr_given = (struct apr_params){.margin = 3.0, .around = 3};
    apr_given.criteria.n = 1;
    apr_given.criteria.of[0] =
        (struct apr_criterion){.level = 1, .kind = CRITERION_VORTICITY, .above = 0.1};
    struct regions *g = regions_create(&c.run, &c.prm);
    assert_true(g->open[1]);
    evaluate(g, at, 1.0, 0.0);
    const double end = 1.0 - 2.5 * 0.05 - 0.05; /* transition, buffer, R */
    assert_true(regions_distance(g, 1, (const double[]){end + 1e-6, 0.5, 0.0}) < 0.0);
    assert_true(regions_distance(g, 1, (const double[]){end - 0.07, 0.5, 0.0}) > 0.0);
    DROP(g);
}

TEST(a_restart_goes_on_the_same)
{
    struct sph_case c;
    struct regions *g = start(&c, 2, 2, 25000.0), *h;
    char path[] = "/tmp/estran_criteria_XXXXXX";
    if (c.run.rank == 0)
        close(mkstemp(path));
    MPI_Bcast(path, sizeof path, MPI_CHAR, 0, MPI_COMM_WORLD);
    evaluate(g, (const double[]){0.5, 0.5, 0.0}, 1.0, 0.0);
    evaluate(g, (const double[]){0.52, 0.5, 0.0}, 0.9, 0.01);
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    assert_true(regions_restart(g, f));
    h5_close(&f);
    f = h5_open(MPI_COMM_WORLD, path);
    h = start(&c, 2, 2, 25000.0);
    assert_true(regions_restart(h, f));
    h5_close(&f);
    for (int turn = 0; turn < 3; turn++) {
        long different = 0;
        assert_true(criteria_due(g, 0.0101) == criteria_due(h, 0.0101));
        for (int n = 1; n <= 2; n++)
            different += memcmp(g->level[n].cells->mark, h->level[n].cells->mark,
                                marks_count(g->level[n].cells)) != 0;
        assert_true(none_anywhere(different));
        evaluate(g, (const double[]){0.55, 0.5, 0.0}, 0.8, 0.02 * (turn + 1));
        evaluate(h, (const double[]){0.55, 0.5, 0.0}, 0.8, 0.02 * (turn + 1));
    }
    DROP(g);
    DROP(h);
    if (c.run.rank == 0)
        remove(path);
}

/* Marks and forecast do not depend on which rank says what: 64-bit FNV of the marks against the one
 * that rank 0 finds alone. */
TEST(ranks_do_not_matter)
{
    struct sph_case c, alone;
    const double at[3] = {0.55, 0.4, 0.0};
    struct regions *g = start(&c, 2, 2, 20000.0);
    evaluate(g, at, 1.0, 0.0);
    struct regions *h = start(&alone, 2, 2, 20000.0);
    alone.run.comm = MPI_COMM_SELF;
    alone.run.rank = 0;
    alone.run.size = 1;
    evaluate(h, at, 1.0, 0.0);
    long different = criteria_forecast(g) != criteria_forecast(h);
    for (int n = 1; n <= 2; n++)
        different += memcmp(g->level[n].cells->mark, h->level[n].cells->mark,
                            marks_count(g->level[n].cells)) != 0;
    assert_true(none_anywhere(different));
    DROP(g);
    DROP(h);
}
