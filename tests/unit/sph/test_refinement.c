/* test_refinement.c - levels of refinement: what they must leave as it is.
 * ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/refinement/guards.h"
#include "../../../sph/refinement/refinement.h"
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
    return ranks_sum(q->run->comm, n);
}

/* Particles of all levels set in motion. */
static void set_moving(struct sph *s, const double *U)
{
    for (struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            double *y = state_row(&q->p, q->p.y, i);
            for (int a = 0; a < q->dim && a < 3; a++)
                y[q->dim + a] = y[at_mass(q->dim)] * U[a];
        }
    for (int a = 0; a < 3; a++)
        s->start.momentum[a] = s->start.mass * U[a];
    integrate_start(s);
}

/* Largest difference from U, and of density from 1, guards included. */
static double departure(const struct sph *s, const double *U)
{
    double worst = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i), m = y[at_mass(q->dim)];
            for (int a = 0; a < q->dim; a++)
                worst = fmax(worst, fabs(y[q->dim + a] / m - U[a]));
            worst = fmax(worst, fabs(m / y[at_volume(q->dim)] - 1.0));
        }
    return max_anywhere(worst);
}

static void start_at_rest(struct sph_case *c, int dim, int cells)
{
    sph_case_set(c, dim, cells);
    c->run.scene.initial.field = FIELD_REST;
    c->run.scene.fluid.nu = 0.0;
}

/* A lattice that is carried through the box once around: births and removals, and every guard gets
 * what is everywhere. */
static void carry(bool local_steps)
{
    const double U[3] = {1.0, 0.0, 0.0};
    struct sph_case c;
    start_at_rest(&c, 2, 20);
    refine(&c, 1, 0.1, 0.9);
    apr_given.local_steps = local_steps;
    struct sph *s = sph_case_start(&c, NULL);
    assert_true(s->finer != NULL && s->finer->finer == NULL);
    set_moving(s, U);
    const double n[2] = {flowing(s), flowing(s->finer)};
    while (s->t < (SANITIZED ? 0.1 : 1.0))
        assert_true(sph_case_run(&c, 1, 1.0));
    assert_true(departure(s, U) < 1e-10);
    assert_true(flowing(s) == n[0] && flowing(s->finer) == n[1]);
    DROP(c.s);
    refine_nothing();
}

TEST(translation_is_exact)
{
    carry(false);
    carry(true);
}

/* The same for a part of the way through nested boxes, and in space. */
TEST(nested_boxes_and_space_are_exact)
{
    const double U[3] = {0.6, 1.0, 0.3};
    for (int dim = 2; dim <= 3; dim++) {
        struct sph_case c;
        start_at_rest(&c, dim, dim == 2 ? 24 : 12);
        if (dim == 2)
            c.prm.R_dx = 3.0;
        refine(&c, 4 - dim, dim == 2 ? 0.4 : 0.2, dim == 2 ? 0.6 : 0.8);
        apr_given.margin = 1.5;
        apr_given.local_steps = dim == 2; /* in space with the step of the finest */
        struct sph *s = sph_case_start(&c, NULL);
        set_moving(s, U);
        for (const struct sph *q = s; q; q = q->finer)
            assert_true(flowing(q) > 0.0);
        assert_true(sph_case_run(&c, SANITIZED ? 2 : dim == 2 ? 10 : 4, 100.0));
        assert_true(departure(s, U) < 1e-10);
        DROP(c.s);
    }
    refine_nothing();
}

/* Regions that lie elsewhere, or hold a particle or two: levels that are empty or nearly so. */
TEST(empty_levels_run)
{
    const double U[3] = {1.0, 0.0, 0.0}, ends[2] = {0.501, 0.53};
    for (int k = 0; k < 2; k++) {
        struct sph_case c;
        start_at_rest(&c, 2, 20);
        refine(&c, 1, 0.5, ends[k]);
        struct sph *s = sph_case_start(&c, NULL);
        set_moving(s, U);
        assert_true(sph_case_run(&c, 20, 100.0));
        assert_true(departure(s, U) < 1e-10);
        assert_true(flowing(s) == 400.0 && flowing(s->finer) == 0.0);
        DROP(c.s);
    }
    refine_nothing();
}

/* Gives all but guards the fields rho = 1 + k.x, u = (0.1, 0) + K x of the slopes k, K, lets guards
 * take theirs, and returns the largest error of these: further than the support from sides, across
 * which fields jump; walls: but those along x. */
static double guards_off(struct sph *s, const double slopes[6], bool walls)
{
    const double *k = slopes, *K = slopes + 2;
    double worst = 0.0;
    for (struct sph *q = s; q; q = q->finer) {
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i), x[2] = {y[0], y[1]};
            const double rho = 1.0 + k[0] * x[0] + k[1] * x[1];
            const double u[2] = {0.1 + K[0] * x[0] + K[1] * x[1], K[2] * x[0] + K[3] * x[1]};
            memcpy(slope_line(&q->p, i), slopes, 6 * sizeof *slopes);
            if (!particles_is_guard(&q->p, i))
                particles_set(q, i, x, u, y[4], rho);
        }
        particles_lines(q);
    }
    guards_update(s);
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *p = prim_line(&q->p, i), y = walls ? 0.5 : p[1];
            if (!particles_is_guard(&q->p, i) || fmin(p[0], y) <= 0.11 || fmax(p[0], y) >= 0.89)
                continue;
            worst = fmax(worst, fabs(p[5] - 1.0 - k[0] * p[0] - k[1] * p[1]));
            worst = fmax(worst, fabs(p[2] - 0.1 - K[0] * p[0] - K[1] * p[1]));
            worst = fmax(worst, fabs(p[3] - K[2] * p[0] - K[3] * p[1]));
        }
    return max_anywhere(worst);
}

/* Guards are given linear fields exactly where their sources have the slopes of these, however
 * these stand. */
TEST(guards_take_linear_fields)
{
    struct sph_case c;
    start_at_rest(&c, 2, 20);
    c.prm.noise = 0.2;
    refine(&c, 1, 0.1, 0.9);
    struct sph *s = sph_case_start(&c, NULL);
    s->lists.ready = false;
    integrate_prepare(s);
    assert_true(guards_off(s, (const double[]){0.01, -0.02, 0.0, 0.3, 0.2, -0.4}, false) < 1e-12);
    DROP(c.s);
    refine_nothing();
}

/* The same beside a plane side, whose mirror images are no sources. */
TEST(guards_beside_walls_take_linear_fields)
{
    struct sph_case c;
    start_at_rest(&c, 2, 20);
    c.prm.noise = 0.2;
    c.prm.walls = WALLS_GHOSTS;
    c.run.scene.domain.periodic[1] = false;
    c.run.scene.nwalls = 2;
    c.run.scene.walls[0].side = SIDE_Y_MIN;
    c.run.scene.walls[1].side = SIDE_Y_MAX;
    refine(&c, 1, 0.1, 0.9);
    apr_given.regions.of[0].min[1] = -1.0;
    struct sph *s = sph_case_start(&c, NULL);
    s->lists.ready = false;
    integrate_prepare(s);
    assert_true(guards_off(s, (const double[]){0.01, 0.0, 0.3, 0.0, 0.0, 0.0}, true) < 1e-12);
    DROP(c.s);
    refine_nothing();
}

/* Levels about an oblique face, whose first particles were packed: children of all generations
 * stand before it, and none is lost in the first steps. */
TEST(nobody_is_born_behind_walls)
{
    struct sph_case c;
    long behind = 0;
    start_at_rest(&c, 2, 40);
    c.prm.R_dx = 3.0;
    c.prm.packing = 40;
    c.run.scene.nbodies = 1;
    c.run.scene.bodies[0].points.n = 3;
    memcpy(c.run.scene.bodies[0].points.x, (double[3][2]){{0.3, 0.3}, {0.5, 0.7}, {0.7, 0.3}},
           6 * sizeof(double));
    refine(&c, 6, 0.0, 0.0);
    apr_given.margin = 1.5;
    memcpy(apr_given.regions.of[0].min, (double[2]){0.38, 0.48}, 2 * sizeof(double));
    memcpy(apr_given.regions.of[0].max, (double[2]){0.42, 0.52}, 2 * sizeof(double));
    struct sph *s = sph_case_start(&c, NULL);
    for (const struct sph *q = s; q; q = q->finer) {
        assert_true(flowing(q) > 0.0);
        for (int i = 0; i < q->p.n; i++)
            behind += !(walls_distance(q->walls, state_row(&q->p, q->p.y, i), 1.0) > 0.0);
    }
    assert_true(none_anywhere(behind));
    assert_true(sph_case_run(&c, 3, 100.0));
    assert_true(max_anywhere(s->total.lost) == 0.0);
    DROP(c.s);
    refine_nothing();
}

/* Root of the mean square error of the velocity of Taylor-Green vortices of Re 200, over U. */
static double vortex_error(const struct sph *s)
{
    double sums[2] = {0.0, 0.0};
    const double k = 2.0 * M_PI, decay = exp(-2.0 * k * k * 0.005 * s->t);
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i), w = y[4];
            const double u = decay * sin(k * y[0]) * cos(k * y[1]);
            const double v = -decay * cos(k * y[0]) * sin(k * y[1]);
            if (particles_is_guard(&q->p, i))
                continue;
            sums[0] += w * (pow(y[2] / y[5] - u, 2.0) + pow(y[3] / y[5] - v, 2.0));
            sums[1] += w;
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return sqrt(sums[0] / sums[1]);
}

/* Vortices through two boxes: with steps of their own the coarser levels take a quarter of the
 * steps, and the error is at most 1.2 times that with one step for all; mass is not lost either. */
TEST(local_steps_are_as_good)
{
    static const int schemes[2] = {SCHEME_RIEMANN, SCHEME_RIEMANN_ALE};
    for (int k = SANITIZED; k < 2; k++) {
        double error[2], mass[2];
        int64_t steps[2];
        for (int local = 0; local < 2; local++) {
            struct sph_case c;
            sph_case_set(&c, 2, 32);
            c.prm.R_dx = 3.0;
            c.prm.scheme = schemes[k];
            refine(&c, 2, 0.35, 0.65);
            apr_given.margin = 1.5;
            apr_given.local_steps = local;
            struct sph *s = sph_case_start(&c, NULL);
            while (s->t < (SANITIZED ? 0.006 : 0.1))
                assert_true(sph_case_run(&c, 1, 0.1));
            double sums[SUM_COUNT];
            sph_sums(s, sums);
            error[local] = vortex_error(s);
            mass[local] = fabs(sums[SUM_MASS] - 1.0);
            steps[local] = c.run.step;
            DROP(c.s);
        }
        if (SANITIZED)
            continue;
        assert_true(error[0] < 0.03 && error[1] < 1.2 * error[0]);
        assert_true(mass[1] < fmax(1.2 * mass[0], 1e-3));
        assert_true(steps[0] >= 3 * steps[1]);
    }
    refine_nothing();
}

/* Guards of the finer level, all ranks. */
static double guards_of(const struct sph *q)
{
    double n = 0.0;
    for (int i = 0; i < q->p.n; i++)
        n += particles_is_guard(&q->p, i);
    return ranks_sum(q->run->comm, n);
}

/* Where guards of the edge have been lost others are born, then no more; nothing flows for it. */
TEST(missing_children_are_born_again)
{
    const double U[3] = {0.0, 0.0, 0.0};
    struct sph_case c;
    start_at_rest(&c, 2, 24);
    refine(&c, 1, 0.1, 0.9);
    struct sph *s = sph_case_start(&c, NULL), *fine = s->finer;
    const double before = guards_of(fine);
    assert_true(sph_case_run(&c, SANITIZED ? 3 : 40, 100.0));
    assert_true(guards_of(fine) == before); /* nothing is missing */
    int n = 0;
    for (int i = 0; i < fine->p.n; i++)
        if (!particles_is_guard(&fine->p, i) || fine->p.id[i] % 4 > 0)
            particles_copy(&fine->p, n++, i);
    fine->p.n = n;
    fine->lists.ready = false;
    assert_true(guards_of(fine) < 0.85 * before);
    assert_true(
        sph_case_run(&c, SANITIZED ? 8 : 100, 100.0)); /* one for each disc of R/2 in two steps */
    const double after = guards_of(fine);
    print_message("guards: %.0f, %.0f after losses\n", before, after);
    if (!SANITIZED) {
        assert_true(after > 0.9 * before && after < 1.02 * before);
        assert_true(sph_case_run(&c, 40, 100.0));
        assert_true(fabs(guards_of(fine) - after) < 0.02 * before);
    }
    assert_true(departure(s, U) < 1e-3);
    DROP(c.s);
    refine_nothing();
}
