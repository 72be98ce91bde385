/* test_wall_thin.c - thin walls and narrow gaps are found at any angle, corners are none.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/walls/wall_thin.h"

/* Points turned by an angle; in reverse order if backwards. */
static void set_points(struct param_points *p, int n, double x[][2], double angle, bool backwards)
{
    const double c = cos(angle), s = sin(angle);
    p->n = n;
    for (int k = 0; k < n; k++) {
        const double *from = x[backwards ? n - 1 - k : k];
        p->x[k][0] = c * from[0] - s * from[1];
        p->x[k][1] = s * from[0] + c * from[1];
    }
}

static struct scene *scene_new(void)
{
    struct scene *c = calloc(1, sizeof *c);
    c->domain.dim = 2;
    for (int a = 0; a < 2; a++) {
        c->domain.min[a] = -5.0;
        c->domain.max[a] = 5.0;
    }
    return c;
}

static double any_angle(void) { return 6.28 * rand() / RAND_MAX; }

/* A plate 0.2 thick and 3 long as a body, whichever way round it is given; with a gap in its
 * outline as an open wall; its upper and lower face as two walls. */
TEST(plates_are_thin)
{
    double plate[4][2] = {{-1.5, -0.1}, {-1.5, 0.1}, {1.5, 0.1}, {1.5, -0.1}};
    struct wall_thin t;
    for (int k = 0; k < 20; k++) {
        struct scene *c = scene_new();
        const double angle = any_angle();
        c->nbodies = 1;
        set_points(&c->bodies[0].points, 4, plate, angle, k % 2);
        assert_true(wall_thin_solid(c, 0.3, &t));
        assert_close(t.width, 0.2, 1e-9);
        assert_true(hypot(t.at[0], t.at[1]) < 1.6);
        assert_false(wall_thin_solid(c, 0.19, &t));
        c->nbodies = 0;
        c->nwalls = 1;
        double open[4][2] = {{-1.5, 0.1}, {1.5, 0.1}, {1.5, -0.1}, {-1.5, -0.1}};
        set_points(&c->walls[0].points, 4, open, angle, false);
        assert_true(wall_thin_solid(c, 0.3, &t));
        c->nwalls = 2;
        set_points(&c->walls[0].points, 2, plate + 1, angle, false);
        double lower[2][2] = {{1.5, -0.1}, {-1.5, -0.1}};
        set_points(&c->walls[1].points, 2, lower, angle, false);
        assert_true(wall_thin_solid(c, 0.3, &t));
        assert_false(wall_thin_solid(c, 0.19, &t));
        free(c);
    }
}

/* Wedges from 6 to 120 degrees, alone or as two walls that meet; the small square. */
TEST(corners_are_not_thin)
{
    struct wall_thin t;
    for (int k = 0; k < 40; k++) {
        struct scene *c = scene_new();
        const double half = (3.0 + 57.0 * k / 39.0) * M_PI / 180.0, angle = any_angle();
        double wedge[3][2] = {{cos(half), -sin(half)}, {0.0, 0.0}, {cos(half), sin(half)}};
        double square[4][2] = {{0.0, 0.0}, {0.0, 0.1}, {0.1, 0.1}, {0.1, 0.0}};
        c->nbodies = 1;
        set_points(&c->bodies[0].points, 3, wedge, angle, k % 2);
        assert_false(wall_thin_solid(c, 0.08, &t)); /* its base is wider */
        set_points(&c->bodies[0].points, 4, square, angle, k % 2);
        assert_false(wall_thin_solid(c, 0.3, &t));
        c->nbodies = 0;
        c->nwalls = 2;
        set_points(&c->walls[0].points, 2, wedge, angle, false);
        set_points(&c->walls[1].points, 2, wedge + 1, angle, false);
        assert_false(wall_thin_solid(c, 0.3, &t));
        assert_false(wall_thin_gap(c, 0.3, &t));
        /* the fluid between them instead */
        set_points(&c->walls[0].points, 2, wedge, angle, true);
        set_points(&c->walls[1].points, 2, wedge + 1, angle, true);
        assert_false(wall_thin_gap(c, 0.05, &t));
        free(c);
    }
}

/* A box over the floor: on it, too near, far enough; a cylinder that nearly touches it. */
TEST(gaps)
{
    struct scene *c = scene_new();
    struct wall_thin t;
    double circle[32][2];
    c->nwalls = c->nbodies = 1;
    c->walls[0].side = SIDE_Y_MIN;
    for (int k = 0; k < 3; k++) {
        const double y = -5.0 + 0.05 * k;
        double box[4][2] = {{-1.0, y}, {-1.0, y + 1.0}, {1.0, y + 1.0}, {1.0, y}};
        set_points(&c->bodies[0].points, 4, box, 0.0, false);
        assert_true(wall_thin_gap(c, 0.1 - 1e-6, &t) == (k == 1));
        assert_false(wall_thin_solid(c, 0.1, &t));
    }
    for (int k = 0; k < 32; k++) {
        circle[k][0] = 0.3 * cos(-k * M_PI / 16.0);
        circle[k][1] = 0.3 * sin(-k * M_PI / 16.0) - 4.65;
    }
    set_points(&c->bodies[0].points, 32, circle, 0.0, false);
    assert_false(wall_thin_gap(c, 0.1, &t));
    /* a large one that stands on the floor, of 40 corners: 4.5 degrees beside the lowest; and a
     * wedge of 2 degrees */
    c->bodies[0].points.n = 40;
    for (int k = 0; k < 40; k++) {
        c->bodies[0].points.x[k][0] = -0.8 * sin(k * M_PI / 20.0);
        c->bodies[0].points.x[k][1] = -5.0 + 0.8 * (1.0 - cos(k * M_PI / 20.0));
    }
    assert_false(wall_thin_gap(c, 0.1, &t));
    double wedge[4][2] = {
        {0.0, -5.0}, {-1.5, -5.0 + 1.5 * tan(M_PI / 90.0)}, {-1.5, -4.0}, {0.0, -4.0}};
    set_points(&c->bodies[0].points, 4, wedge, 0.0, false);
    assert_true(wall_thin_gap(c, 0.1, &t));
    free(c);
}

/* A slot between two plates is a passage, and one between a plate and a side; a tank that is as
 * narrow is none, nor are the two sides of a nozzle that one line draws, nor a block that is far.
 */
TEST(passages)
{
    struct scene *c = scene_new();
    struct wall_thin t;
    double left[4][2] = {{-2.0, 0.0}, {-0.1, 0.0}, {-0.1, -0.2}, {-2.0, -0.2}};
    double right[4][2] = {{0.1, 0.0}, {2.0, 0.0}, {2.0, -0.2}, {0.1, -0.2}};
    c->nbodies = 2;
    c->fluid.gravity[1] = -9.81;
    set_points(&c->bodies[0].points, 4, left, 0.0, false);
    set_points(&c->bodies[1].points, 4, right, 0.0, false);
    c->nshapes = 1;
    c->shapes[0] = (struct scene_shape){.form = SHAPE_BELOW, .level = -1.0}; /* out of its way */
    assert_false(wall_thin_passage(c, 0.21, &t));
    c->shapes[0].level = 5.0;
    assert_false(wall_thin_passage(c, 0.21, &t));
    c->shapes[0] = (struct scene_shape){.form = SHAPE_BOX, .box = {{-2.0, 0.0}, {2.0, 1.0}}};
    assert_true(wall_thin_passage(c, 0.21, &t));
    assert_close(t.width, 0.2, 1e-9);
    assert_close(t.at[0], 0.0, 1e-9);
    assert_false(wall_thin_passage(c, 0.19, &t));
    c->bodies[1].free = true;
    assert_false(wall_thin_passage(c, 0.21, &t));
    c->nbodies = 0;
    c->nwalls = 2;
    c->walls[0].side = SIDE_X_MIN;
    c->walls[1].side = SIDE_X_MAX;
    assert_false(wall_thin_passage(c, 2.0 * (c->domain.max[0] - c->domain.min[0]), &t));
    c->nbodies = 1;
    left[0][0] = left[3][0] = -4.8;
    set_points(&c->bodies[0].points, 4, left, 0.0, false);
    c->shapes[0].box[0][0] = -5.0;
    assert_true(wall_thin_passage(c, 0.21, &t)); /* to the side */
    assert_close(t.width, 0.2, 1e-9);
    assert_close(t.at[0], -4.9, 1e-9);
    free(c);
}

/* A sill 0.2 high that lies on the floor, on another body or on a line has fluid on one side. */
TEST(sills_are_not_thin)
{
    double sill[4][2] = {{-1.5, 0.0}, {-1.5, 0.2}, {1.5, 0.2}, {1.5, 0.0}},
           base[4][2] = {{-2.0, -1.0}, {-2.0, 0.0}, {2.0, 0.0}, {2.0, -1.0}};
    struct wall_thin t;
    struct scene *c = scene_new();
    c->nbodies = 1;
    set_points(&c->bodies[0].points, 4, sill, 0.0, false);
    assert_true(wall_thin_solid(c, 0.3, &t));
    c->domain.min[1] = 0.0;
    assert_false(wall_thin_solid(c, 0.3, &t));
    c->domain.min[1] = -5.0;
    for (int k = 0; k < 20; k++) {
        const double angle = any_angle();
        set_points(&c->bodies[0].points, 4, sill, angle, k % 2);
        c->nbodies = 2;
        set_points(&c->bodies[1].points, 4, base, angle, k % 2);
        assert_false(wall_thin_solid(c, 0.3, &t));
        c->nbodies = 1;
        c->nwalls = 1;
        set_points(&c->walls[0].points, 2, base + 1, angle, true);
        assert_false(wall_thin_solid(c, 0.3, &t));
        c->nwalls = 0;
    }
    free(c);
}

void unit_begin(void) { srand(11); }
