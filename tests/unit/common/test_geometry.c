/* test_geometry.c - lines of a scene: sense, crossings, gaps and overlaps, whatever their place,
 * size and turn; walls and bodies that run the wrong way are turned, others are not; shapes across
 * periods. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/scene/scene_fluid.h"
#include "../../../common/scene/scene_forms.h"
#include "../../../common/scene/scene_geometry.h"

/* In [0, 1): the same on every machine (Numerical Recipes' quick generator). */
static double dice(void)
{
    static uint32_t seed = 12345;
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) / (double)(1 << 24);
}

struct placing {
    double scale, angle, shift[2];
    bool mirrored;
};

static struct placing anywhere(void)
{
    static const double scales[] = {1e-3, 1.0, 1e3};
    const double scale = scales[(int)(3.0 * dice())];
    return (struct placing){.scale = scale,
                            .angle = 6.28 * dice(),
                            .shift = {scale * 100.0 * dice(), -scale * 100.0 * dice()},
                            .mirrored = dice() < 0.5};
}

static void put(const struct placing *p, const double *from, double *to)
{
    const double c = cos(p->angle), s = sin(p->angle), x = p->mirrored ? -from[0] : from[0];
    to[0] = p->shift[0] + p->scale * (c * x - s * from[1]);
    to[1] = p->shift[1] + p->scale * (s * x + c * from[1]);
}

static struct param_points placed(const struct placing *p, const double (*x)[2], int n)
{
    struct param_points to = {.n = n};
    for (int k = 0; k < n; k++)
        put(p, x[k], to.x[k]);
    return to;
}

/* A star-shaped outline, counter-clockwise. */
static struct param_points blob(const struct placing *p, int n)
{
    double x[PARAM_POINTS_MAX][2];
    for (int k = 0; k < n; k++) {
        const double r = 0.5 + 0.5 * dice(), a = 2.0 * M_PI * (k + 0.5 * dice()) / n;
        x[k][0] = r * cos(a);
        x[k][1] = r * sin(a);
    }
    return placed(p, (const double(*)[2])x, n);
}

TEST(sense_is_that_of_the_points)
{
    for (int trial = 0; trial < 300; trial++) {
        const struct placing p = anywhere();
        struct param_points b = blob(&p, 3 + (int)(97.0 * dice()));
        struct line l = line_of(&b, true);
        double at[2];
        const double area = line_area(&l);
        assert_true(p.mirrored ? area < 0.0 : area > 0.0);
        assert_int_equal(line_check(&l, at), LINE_SOUND);
        points_reverse(&b);
        assert_close(line_area(&l), -area, 1e-12 * fabs(area));
    }
}

TEST(a_line_that_crosses_itself_is_found_with_its_place)
{
    static const double eight[][2] = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
    for (int trial = 0; trial < 200; trial++) {
        const struct placing p = anywhere();
        struct param_points b = placed(&p, eight, 4);
        struct line l = line_of(&b, true);
        double at[2], middle[2];
        put(&p, (const double[2]){1.0, 1.0}, middle);
        assert_int_equal(line_check(&l, at), LINE_CROSSED);
        l.closed = false;
        assert_int_equal(line_check(&l, at), LINE_CROSSED);
        assert_close(hypot(at[0] - middle[0], at[1] - middle[1]), 0.0, 1e-6 * p.scale);

        struct param_points c = blob(&p, 12); /* two corners change places */
        const double x[2] = {c.x[2][0], c.x[2][1]};
        memcpy(c.x[2], c.x[7], sizeof x);
        memcpy(c.x[7], x, sizeof x);
        l = line_of(&c, true);
        assert_int_equal(line_check(&l, at), LINE_CROSSED);
    }
}

TEST(what_is_no_line_is_refused)
{
    static const double twice[][2] = {{0, 0}, {1, 0}, {1, 0}, {1, 1}};
    static const double flat[][2] = {{0, 0}, {1, 0}, {2, 0}, {0.5, 0}};
    static const double spike[][2] = {{0, 0}, {1, 0}, {1, 1}, {1, 0.5}, {0, 1}};
    static const double touch[][2] = {{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}};
    static const double round[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}};
    for (int trial = 0; trial < 50; trial++) {
        const struct placing p = anywhere();
        double at[2];
        struct param_points b = placed(&p, twice, 4);
        struct line l = line_of(&b, true);
        assert_int_equal(line_check(&l, at), LINE_REPEATED);
        b = placed(&p, flat, 4);
        assert_int_equal(line_check(&l, at), LINE_FLAT);
        b = placed(&p, spike, 5);
        l = line_of(&b, true);
        assert_int_equal(line_check(&l, at), LINE_FOLDED);
        b = placed(&p, touch, 5);
        assert_int_equal(line_check(&l, at), LINE_CROSSED);
        b = placed(&p, round, 4);
        l = line_of(&b, false);
        line_trim(&l);
        assert_true(l.closed && l.n == 3);
        assert_int_equal(line_check(&l, at), LINE_SOUND);
    }
}

TEST(gaps_and_overlaps_are_told_apart)
{
    static const double one[][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    static const double beside[][2] = {{1, 0.2}, {1, 0.8}, {2, 0.8}, {2, 0.2}};
    static const double apart[][2] = {{1.01, 0.2}, {1.01, 0.8}, {2, 0.8}, {2, 0.2}};
    static const double into[][2] = {{0.9, 0.2}, {0.9, 0.8}, {2, 0.8}, {2, 0.2}};
    static const double within[][2] = {{0.4, 0.4}, {0.5, 0.6}, {0.6, 0.4}};
    for (int trial = 0; trial < 50; trial++) {
        const struct placing p = anywhere();
        double at[2];
        const struct param_points a = placed(&p, one, 4);
        const struct line A = line_of(&a, true);
        const struct {
            const double (*x)[2];
            int n;
            double gap;
            bool overlaps;
        } others[] = {{beside, 4, 0.0, false},
                      {apart, 4, 0.01, false},
                      {into, 4, 0.0, true},
                      {within, 3, 0.4, true},
                      {one, 4, 0.0, true}};
        for (int k = 0; k < 5; k++) {
            const struct param_points b = placed(&p, others[k].x, others[k].n);
            const struct line B = line_of(&b, true);
            assert_close(line_gap(&A, &B, at), p.scale * others[k].gap, 1e-9 * p.scale);
            assert_int_equal(line_overlaps(&A, &B, at), others[k].overlaps);
            assert_int_equal(line_overlaps(&B, &A, at), others[k].overlaps);
        }
    }
}

/* Water in a polygon inside a domain that is much larger, all placed alike. */
static void scene_at(struct scene *s, const struct placing *p, const double (*x)[2], int n)
{
    memset(s, 0, sizeof *s);
    s->fluid.rho = 1000.0;
    s->domain.dim = 2;
    s->initial.U = s->initial.L = 1.0;
    for (int a = 0; a < 2; a++) {
        s->domain.min[a] = p->shift[a] - 10.0 * p->scale;
        s->domain.max[a] = p->shift[a] + 10.0 * p->scale;
    }
    s->nshapes = 1;
    s->shapes[0].form = SHAPE_POLYGON;
    s->shapes[0].points = placed(p, x, n);
}

/* A line in both senses, given with its water on the left: it has it there afterwards. */
static void in_both_senses(const struct placing *p, const double (*x)[2], int n, bool closed,
                           const double (*water)[2], int nwater)
{
    for (int reversed = 0; reversed < 2; reversed++) {
        struct scene s;
        scene_at(&s, p, water, nwater);
        s.nwalls = 1;
        s.walls[0].points = placed(p, x, n);
        s.walls[0].closed = closed;
        if (reversed)
            points_reverse(&s.walls[0].points);
        scene_orient(&s);
        assert_int_equal(s.walls[0].turned, (reversed != 0) != p->mirrored);
    }
}

TEST(walls_that_run_the_wrong_way_are_turned)
{
    static const double tank[][2] = {{-1, 1}, {-1, -1}, {1, -1}, {1, 1}};
    static const double in_tank[][2] = {{-1, 0.5}, {-1, -1}, {1, -1}, {1, 0.5}};
    static const double bed[][2] = {{-2.9, -1}, {-0.5, -1}, {0, -0.4}, {0.5, -1}, {2.9, -1}};
    static const double dam[][2] = {{-2.9, -1}, {-1, -1}, {-1, 0}, {-2.9, 0}};
    static const double hull[][2] = {{0, 0}, {3, 0}, {3, 2}, {0, 2}};
    static const double bilge[][2] = {{0, 0}, {3, 0}, {3, 0.3}, {0, 0.3}};
    for (int trial = 0; trial < 60; trial++) {
        const struct placing p = anywhere();
        in_both_senses(&p, tank, 4, false, in_tank, 4);
        in_both_senses(&p, bed, 5, false, dam, 4);
        in_both_senses(&p, hull, 4, true, bilge, 4);
    }
}

/* An island in water that the shapes let go on through it, and a fillet in a corner. */
TEST(walls_with_water_on_both_sides_stay)
{
    static const double island[][2] = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}};
    static const double fillet[][2] = {{-3, -1}, {-1, -3}};
    static const double sea[][2] = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
    for (int trial = 0; trial < 60; trial++)
        for (int reversed = 0; reversed < 2; reversed++) {
            const struct placing p = anywhere();
            struct scene s;
            scene_at(&s, &p, sea, 4);
            s.nwalls = 2;
            s.walls[0].points = placed(&p, island, 4);
            s.walls[0].closed = true;
            s.walls[1].points = placed(&p, fillet, 2);
            for (int k = 0; k < 2 && reversed; k++)
                points_reverse(&s.walls[k].points);
            scene_orient(&s);
            assert_false(s.walls[0].turned || s.walls[1].turned);
        }
}

/* A line of four corners in a half-filled tank that lies on one of its sides, under gravity g: it
 * is left as it is drawn, or has its fluid outside. */
static void check_standing(int side, const double (*corners)[2], bool reversed, double g, bool left)
{
    static const double sea[][2] = {{-9.9, -9.9}, {9.9, -9.9}, {9.9, 0}, {-9.9, 0}};
    struct placing p = anywhere();
    struct scene s;
    p.angle = side * 0.5 * M_PI;
    scene_at(&s, &p, sea, 4);
    s.fluid.gravity[0] = g * sin(p.angle);
    s.fluid.gravity[1] = -g * cos(p.angle);
    s.nwalls = 2;
    s.walls[0].points = placed(&p, corners, 4);
    s.walls[1].side = SIDE_X_MIN;
    if (reversed)
        points_reverse(&s.walls[0].points);
    scene_orient(&s);
    const struct line l = line_of(&s.walls[0].points, true);
    assert_true(left ? !s.walls[0].turned : line_area(&l) < 0.0);
}

/* A baffle from a side of a tank of walls, with water inside it, too, as a level draws it, and a
 * channel that is drawn into the same tank and holds half of its water. */
TEST(baffles_have_their_fluid_outside)
{
    static const double baffle[][2] = {{-1, 10}, {-1, -3}, {1, -3}, {1, 10}};
    static const double channel[][2] = {{-9, 10}, {-4, -9}, {4, -9}, {9, 10}};
    for (int trial = 0; trial < 60; trial++)
        for (int reversed = 0; reversed < 2; reversed++)
            for (int side = 0; side < 4; side++) { /* the same tank on each of its sides */
                check_standing(side, trial % 2 ? channel : baffle, reversed, 0.0, trial % 2);
            }
}

/* A dyke on the floor, whose share of the water a level draws into it, too; a hood that most of the
 * water is under stays as it is drawn, and so does the dyke where nothing says what is down. */
TEST(dykes_have_their_fluid_outside)
{
    static const double dyke[][2] = {{3, -11}, {1, 1}, {-1, 1}, {-3, -11}};
    static const double hood[][2] = {{8, -11}, {8, -1}, {-8, -1}, {-8, -11}};
    for (int trial = 0; trial < 60; trial++)
        for (int reversed = 0; reversed < 2; reversed++)
            for (int side = 0; side < 4; side++) {
                check_standing(side, trial % 3 == 1 ? hood : dyke, reversed,
                               trial % 3 == 2 ? 0.0 : 9.81, trial % 3 > 0);
            }
}

/* The area is the circle's, as far as corners stay within the radius; edges are the wanted ones,
 * between 32 and 96 of them. */
TEST(discs_have_edges_of_the_wanted_length)
{
    for (int turned = 0; turned < 2; turned++)
        for (double edge = 0.005; edge < 0.03; edge += 0.001) {
            struct scene s = {.domain.dim = 2, .nbodies = 1};
            struct scene_body *b = s.bodies;
            b->radius = 0.1;
            b->surface.scale = 1.0;
            b->surface.translate[0] = 3.0;
            b->turned = turned;
            scene_forms_fit(&s, edge);
            const struct line l = line_of(&b->points, true);
            assert_close(line_area(&l), (turned ? M_PI : -M_PI) * 0.01, 1e-3 * M_PI * 0.01);
            const double first = hypot(l.x[1][0] - l.x[0][0], l.x[1][1] - l.x[0][1]);
            assert_true(first < fmax(edge, 0.2 * M_PI / 96) * 1.01 &&
                        first > 0.8 * fmin(edge, 0.02));
            assert_int_equal(l.n % 4, 0);
        }
}

TEST(bodies_have_their_fluid_outside)
{
    for (int trial = 0; trial < 100; trial++) {
        const struct placing p = anywhere();
        struct scene s;
        scene_at(&s, &p, NULL, 0);
        s.nbodies = 1;
        s.bodies[0].points = blob(&p, 30);
        scene_orient(&s);
        const struct line l = line_of(&s.bodies[0].points, true);
        assert_true(line_area(&l) < 0.0);
        assert_int_equal(s.bodies[0].turned, !p.mirrored);
        double centre[3] = {p.shift[0], p.shift[1], 0.0}, out[3] = {0.0, 0.0, 0.0};
        put(&p, (const double[2]){1.2, 0.0}, out);
        assert_false(scene_is_room(&s, centre));
        assert_true(scene_is_room(&s, out));
    }
}

/* A box of particles may lie across a period, beyond whose side the shapes go on. */
TEST(shapes_have_images_beyond_periods)
{
    struct scene s;
    memset(&s, 0, sizeof s);
    s.domain.dim = 2;
    s.domain.max[0] = 2.4;
    s.domain.max[1] = 1.0;
    s.nshapes = 1;
    s.shapes[0].form = SHAPE_BOX;
    s.shapes[0].box[1][0] = s.shapes[0].box[1][1] = 0.5;
    for (int periodic = 0; periodic < 2; periodic++) {
        s.domain.periodic[0] = periodic;
        for (int k = -4; k < 8; k++) {
            const double x[3] = {0.3 + 0.8 * k, 0.25, 0.0}; /* a third of the period apart */
            const bool in = periodic ? (k + 6) % 3 == 0 : k == 0;
            assert_int_equal(scene_is_fluid(&s, NULL, x, NULL), in);
        }
    }
}
