/* test_regions.c - distances to the edges of regions against brute force; nesting, walls, periods,
 * motion. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/refinement/regions.h"
#include "../../../sph/refinement/regions_parts.h"
#include "sph_case.h"

/* --- helpers --- */

/* Unit square or cube of 40 or 20 particles a side; regions of apr_given. */
static void set(struct sph_case *c, int dim, bool periodic)
{
    sph_case_set(c, dim, dim == 2 ? 40 : 20);
    for (int a = 0; a < dim; a++)
        c->run.scene.domain.periodic[a] = periodic;
    memcpy(c->prm.box[0], c->run.scene.domain.min, sizeof c->prm.box[0]);
    memcpy(c->prm.box[1], c->run.scene.domain.max, sizeof c->prm.box[1]);
    apr_given = (struct apr_params){.margin = 3.0, .around = 3};
}

static struct apr_region *add_box(int level, double x0, double y0, double x1, double y1)
{
    struct apr_region *is = apr_given.regions.of + apr_given.regions.n++;
    *is = (struct apr_region){.level = level, .min = {x0, y0, 0.3}, .max = {x1, y1, 0.7}};
    return is;
}

static struct apr_region *add_ball(int level, double x, double y, double z, double radius)
{
    struct apr_region *is = apr_given.regions.of + apr_given.regions.n++;
    *is = (struct apr_region){
        .level = level, .shape = REGION_SPHERE, .centre = {x, y, z}, .radius = radius};
    return is;
}

/* --- union of boxes --- */

static bool in_some(int n, const struct box *b, const double *x, int dim)
{
    for (int k = 0; k < n; k++) {
        bool in = true;
        for (int a = 0; a < dim; a++)
            in = in && x[a] >= b[k].lo[a] && x[a] <= b[k].hi[a];
        if (in)
            return true;
    }
    return false;
}

/* The nearest point of the other side has in each axis the coordinate of x or lies just beside a
 * face: all such points are tried. */
static double brute(int n, const struct box *b, const double *x, int dim)
{
    const bool in = in_some(n, b, x, dim);
    double best = INFINITY, at[3][17];
    const int m = 4 * n + 1;
    for (int a = 0; a < 3; a++) {
        at[a][0] = x[a];
        for (int k = 0; k < 4 * n; k++)
            at[a][1 + k] = (k & 2 ? b[k / 4].hi[a] : b[k / 4].lo[a]) + (k & 1 ? 1e-9 : -1e-9);
    }
    for (int k = 0; k < (dim == 3 ? m : 1); k++)
        for (int j = 0; j < m; j++)
            for (int i = 0; i < m; i++) {
                const double y[3] = {at[0][i], at[1][j], at[2][k]};
                double r2 = 0.0;
                for (int a = 0; a < dim; a++)
                    r2 += (x[a] - y[a]) * (x[a] - y[a]);
                if (r2 < best && in_some(n, b, y, dim) != in)
                    best = r2;
            }
    return in ? sqrt(best) : -sqrt(best);
}

static void union_of_boxes(int dim, int cases, int points)
{
    for (int c = 0; c < cases; c++) {
        struct box b[4];
        const int n = 1 + c % 4;
        for (int k = 0; k < n; k++)
            for (int a = 0; a < 3; a++) {
                b[k].lo[a] = random_in(0.0, 0.6);
                b[k].hi[a] = b[k].lo[a] + random_in(0.1, 0.4);
            }
        if (c % 3 == 0 && n > 1) { /* two that share a face: no edge between */
            b[1] = b[0];
            b[1].lo[0] = b[0].hi[0];
            b[1].hi[0] += 0.2;
        }
        struct box_union u = box_union_create(NULL, dim, n, b, 1e-9);
        for (int p = 0; p < points; p++) {
            const double x[3] = {random_in(0.0, 1.0), random_in(0.0, 1.0), random_in(0.0, 1.0)};
            assert_close(box_union_distance(&u, x), brute(n, b, x, dim), 1e-8);
        }
        DROP(u.of);
    }
}

TEST(distance_to_boxes_is_exact)
{
    srand(1);
    union_of_boxes(2, 48, 50);
    union_of_boxes(3, 48, 20);
}

/* --- balls that walls cut --- */

static void ball_beside_walls(int dim, const double *centre, double radius)
{
    const struct ball b = {{centre[0], centre[1], centre[2]}, radius};
    const struct box room = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
    const int m = dim == 2 ? 20000 : 300;
    for (int p = 0; p < 10; p++) {
        double x[3] = {0.0, 0.0, 0.0}, best = INFINITY, r = 0.0;
        do {
            r = 0.0;
            for (int a = 0; a < dim; a++) {
                x[a] = random_in(0.0, 1.0);
                r += (x[a] - centre[a]) * (x[a] - centre[a]);
            }
        } while (sqrt(r) >= radius);
        for (int i = 0; i < m; i++)
            for (int j = 0; j < (dim == 3 ? m : 1); j++) {
                const double f = 2.0 * M_PI * i / m;
                const double z = dim == 3 ? 2.0 * (j + 0.5) / m - 1.0 : 0.0, s = sqrt(1.0 - z * z);
                const double y[3] = {centre[0] + radius * s * cos(f),
                                     centre[1] + radius * s * sin(f), centre[2] + radius * z};
                double d = 0.0;
                bool in = true;
                for (int a = 0; a < dim; a++) {
                    d += (x[a] - y[a]) * (x[a] - y[a]);
                    in = in && y[a] >= 0.0 && y[a] <= 1.0;
                }
                best = in ? fmin(best, sqrt(d)) : best;
            }
        const double d = ball_distance(&b, dim, &room, x);
        if (best == INFINITY) {
            assert_true(d == INFINITY);
            continue;
        }
        assert_true(d <= best + 1e-12 && d >= best - (dim == 2 ? 1e-3 : 0.02) * radius);
    }
}

TEST(distance_to_balls_knows_walls)
{
    srand(2);
    ball_beside_walls(2, (const double[]){0.5, 0.5, 0.0}, 0.3);
    ball_beside_walls(2, (const double[]){0.5, 0.1, 0.0}, 0.3);
    ball_beside_walls(2, (const double[]){0.1, -0.1, 0.0}, 0.4);
    ball_beside_walls(2, (const double[]){0.2, 0.8, 0.0}, 0.9);
    ball_beside_walls(2, (const double[]){0.5, 0.5, 0.0}, 0.8);
    ball_beside_walls(3, (const double[]){0.5, 0.5, 0.5}, 0.3);
    ball_beside_walls(3, (const double[]){0.5, 0.1, 0.6}, 0.3);
    ball_beside_walls(3, (const double[]){0.1, 0.0, 0.9}, 0.4);
}

/* --- regions --- */

TEST(levels_lie_within_each_other)
{
    struct sph_case c;
    srand(3);
    for (int dim = 2; dim <= 3; dim++) {
        set(&c, dim, false);
        add_box(3, 0.45, 0.45, 0.55, 0.55);
        add_ball(2, 0.7, 0.6, 0.5, 0.1);
        struct regions *g = regions_create(&c.run, &c.prm);
        assert_int_equal(regions_levels(g), 3);
        for (int k = 0; k < 20000; k++) {
            const double x[3] = {random_in(0.0, 1.0), random_in(0.0, 1.0), random_in(0.0, 1.0)};
            for (int n = 1; n < 3; n++)
                if (regions_distance(g, n + 1, x) > 0.0)
                    assert_true(regions_distance(g, n, x) >=
                                3.0 * regions_R(g, n - 1) * (1 - 1e-9));
        }
        DROP(g);
        assert_null(g);
    }
}

/* Regions as periodic images have them, and faces that meet across the period. */
TEST(periods_are_no_edges)
{
    struct sph_case c;
    set(&c, 2, true);
    add_box(1, -0.2, 0.2, 0.3, 0.8);
    add_box(1, 0.5, 0.9, 0.8, 1.0);
    add_box(1, 0.5, 0.0, 0.8, 0.05);
    add_ball(1, 0.95, 0.5, 0.0, 0.1);
    struct regions *g = regions_create(&c.run, &c.prm);
    assert_close(regions_distance(g, 1, (const double[]){0.0, 0.5, 0.0}), 0.2, 1e-12);
    assert_close(regions_distance(g, 1, (const double[]){0.999, 0.5, 0.0}), 0.199, 1e-12);
    assert_close(regions_distance(g, 1, (const double[]){0.85, 0.5, 0.0}), 0.05, 1e-12);
    assert_close(regions_distance(g, 1, (const double[]){0.65, 1.0, 0.0}), 0.05, 1e-12);
    assert_close(regions_distance(g, 1, (const double[]){0.65, 0.0, 0.0}), 0.05, 1e-12);
    assert_close(regions_distance(g, 1, (const double[]){0.65, 0.98, 0.0}), 0.07, 1e-12);
    DROP(g);
    set(&c, 2, true); /* a whole period: no edges along it */
    add_box(1, 0.0, 0.2, 1.0, 0.8);
    g = regions_create(&c.run, &c.prm);
    assert_close(regions_distance(g, 1, (const double[]){0.001, 0.5, 0.0}), 0.3, 1e-12);
    assert_close(regions_distance(g, 1, (const double[]){0.999, 0.1, 0.0}), -0.1, 1e-12);
    DROP(g);
}

TEST(walls_are_no_edges)
{
    struct sph_case c;
    set(&c, 2, false);
    add_box(1, 0.3, 0.0, 0.7, 0.3);
    struct regions *g = regions_create(&c.run, &c.prm);
    assert_close(regions_distance(g, 1, (const double[]){0.5, 0.001, 0.0}), 0.2, 1e-12);
    assert_close(regions_distance(g, 1, (const double[]){0.35, 0.001, 0.0}), 0.05, 1e-12);
    DROP(g);
    /* the same for a wall of points: a tank smaller than the domain */
    const double tank[4][2] = {{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}};
    set(&c, 2, false);
    c.run.scene.nwalls = 1;
    c.run.scene.walls[0].closed = true;
    c.run.scene.walls[0].points.n = 4;
    memcpy(c.run.scene.walls[0].points.x, tank, sizeof tank);
    add_box(1, 0.3, 0.1, 0.7, 0.4);
    g = regions_create(&c.run, &c.prm);
    assert_true(regions_distance(g, 1, (const double[]){0.5, 0.101, 0.0}) > regions_R(g, 0));
    assert_close(regions_distance(g, 1, (const double[]){0.35, 0.2, 0.0}), 0.05, 1e-12);
    DROP(g);
}

TEST(a_given_outer_region_is_taken)
{
    struct sph_case c;
    set(&c, 2, false);
    add_box(1, 0.2, 0.2, 0.8, 0.8);
    add_box(2, 0.4, 0.4, 0.6, 0.6);
    struct regions *g = regions_create(&c.run, &c.prm);
    assert_close(regions_distance(g, 1, (const double[]){0.3, 0.5, 0.0}), 0.1, 1e-12);
    assert_close(regions_distance(g, 2, (const double[]){0.3, 0.5, 0.0}), -0.1, 1e-12);
    DROP(g);
}

/* Within an offset of a body that has turned, by the points of its outline. */
TEST(bodies_have_layers_that_move)
{
    struct sph_case c;
    const double hull[5][2] = {{0.4, 0.4}, {0.45, 0.6}, {0.5, 0.5}, {0.6, 0.55}, {0.6, 0.4}};
    set(&c, 2, false);
    struct scene_body *b = c.run.scene.bodies;
    *b = (struct scene_body){.name = "hull", .centre = {0.5, 0.5, 0.0}};
    c.run.scene.nbodies = 1;
    b->points.n = 5;
    memcpy(b->points.x, hull, sizeof hull);
    struct apr_region *is = apr_given.regions.of + apr_given.regions.n++;
    *is = (struct apr_region){.level = 1, .shape = REGION_BODY, .body = "hull", .offset = 0.2};
    struct regions *g = regions_create(&c.run, &c.prm);
    const double f = 0.7, dx = 0.05, dy = -0.03;
    struct body_motion now = {.x = {dx, dy, 0.0},
                              .Q = {{cos(f), -sin(f), 0.0}, {sin(f), cos(f), 0.0}, {0, 0, 1.0}}};
    srand(4);
    for (int moved = 0; moved < 2; moved++) {
        for (int p = 0; p < 200; p++) {
            const double x[3] = {random_in(0.0, 1.0), random_in(0.0, 1.0), 0.0};
            double best = INFINITY;
            for (int k = 0; k < 5; k++)
                for (int i = 0; i <= 1000; i++) {
                    const double *p0 = hull[k], *p1 = hull[(k + 1) % 5], w = i / 1000.0;
                    const double r[2] = {p0[0] + w * (p1[0] - p0[0]) - 0.5,
                                         p0[1] + w * (p1[1] - p0[1]) - 0.5};
                    const double y[2] = {0.5 + (moved ? dx + cos(f) * r[0] - sin(f) * r[1] : r[0]),
                                         0.5 + (moved ? dy + sin(f) * r[0] + cos(f) * r[1] : r[1])};
                    best = fmin(best, hypot(x[0] - y[0], x[1] - y[1]));
                }
            const double d = regions_distance(g, 1, x);
            if (best < 0.2)
                assert_close(d, 0.2 - best, 1e-5);
            else
                assert_true(d <= 0.0 && d >= 0.2 - best - 1e-5);
        }
        regions_set_body(g, 0, &now);
        regions_move(g, 0.1);
    }
    DROP(g);
}

/* --- motion --- */

TEST(sets_move_together)
{
    struct sph_case c;
    set(&c, 2, false);
    c.run.scene.time.end = 10.0;
    add_box(2, 0.3, 0.4, 0.4, 0.5)->velocity[0] = 0.1;
    add_box(1, 0.7, 0.7, 0.9, 0.9);
    struct regions *g = regions_create(&c.run, &c.prm);
    const double R = regions_R(g, 0);
    assert_close(regions_dt(g), 0.5 * 0.025 / 4.0 / 0.1, 1e-9);
    for (int k = 0; k <= 20; k++) {
        const double t = 0.1 * k, x = 0.35 + 0.1 * t;
        regions_move(g, t);
        assert_close(regions_distance(g, 2, (const double[]){x - 0.02, 0.45, 0.0}), 0.03, 1e-9);
        assert_close(regions_distance(g, 1, (const double[]){x, 0.45, 0.0}), 0.05 + 3.0 * R, 1e-9);
        assert_close(regions_distance(g, 1, (const double[]){0.85, 0.85, 0.0}), 0.05, 1e-9);
    }
    DROP(g);
}

/* What follows the peak comes to it by half a finest spacing a step and stops within R of it. */
TEST(the_peak_is_followed)
{
    struct sph_case c;
    set(&c, 2, false);
    struct apr_region *is = add_box(1, 0.1, -0.1, 0.4, 0.3);
    snprintf(is->follow, sizeof is->follow, "peak");
    snprintf(is->along, sizeof is->along, "x");
    is->pressure = 100.0;
    struct regions *g = regions_create(&c.run, &c.prm);
    assert_true(regions_want_peak(g));
    const double R1 = regions_R(g, 1), step = 0.5 * 0.025 / 2.0, *shift = g->sets[0].shift;
    regions_set_peak(g, (const double[]){0.7, 0.9}, 99.0);
    regions_move(g, 0.0);
    assert_true(shift[0] == 0.0);
    regions_set_peak(g, (const double[]){0.7, 0.9}, 101.0);
    for (int k = 0; k < 100; k++) {
        const double before = shift[0];
        regions_move(g, 0.0);
        assert_true(shift[0] - before <= step * (1.0 + 1e-9) && shift[0] >= before);
    }
    assert_close(shift[0], 0.7 - 0.25 - R1, 1e-9);
    assert_true(shift[1] == 0.0);
    /* x = 0.65 lies at 0.65 - shift - 0.1 from the lower face; the wall below is no edge */
    assert_close(regions_distance(g, 1, (const double[]){0.65, 0.0, 0.0}), 0.4 + shift[0] - 0.65,
                 1e-9);
    DROP(g);
}

/* What a distance costs goes with the boxes that the complement is cut into. */
TEST(few_boxes_leave_few)
{
    struct sph_case c;
    set(&c, 2, false);
    add_box(1, 0.1, 0.1, 0.5, 0.5);
    add_box(1, 0.3, 0.3, 0.8, 0.7);
    add_box(1, 0.6, 0.1, 0.9, 0.5);
    struct regions *g = regions_create(&c.run, &c.prm);
    assert_true(g->level[1].boxes.nrest <= 16);
    DROP(g);
}
