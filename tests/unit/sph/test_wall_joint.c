/* test_wall_joint.c - points where walls touch and part the fluid: which are found, as bodies move
 * too, and who sees whom across them. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/walls/wall_joint.h"
#include "sph_case.h"

enum { CELLS = 20 };

/* A tank of 1 m, dx 0.05 m, half full, and a body; bed: a line from there to there, unless NULL. */
static struct sph *tank_with(struct sph_case *c, double (*bed)[2], int n, double x[][2])
{
    struct scene *e = sph_case_tank(c, CELLS, 9.81, bed ? 4 : 3);
    e->initial.level = 0.0;
    e->nshapes = 1;
    e->shapes[0] = (struct scene_shape){.form = SHAPE_BELOW, .level = 0.5};
    e->nbodies = 1;
    e->bodies[0].points.n = n;
    memcpy(e->bodies[0].points.x, x, (size_t)n * sizeof *x);
    if (bed) {
        e->walls[e->nwalls].side = SIDE_NONE;
        e->walls[e->nwalls].points.n = 2;
        memcpy(e->walls[e->nwalls++].points.x, bed, 2 * sizeof *bed);
    }
    c->prm.scheme = SCHEME_RIEMANN;
    c->prm.surface = true;
    c->prm.c0 = 40.0;
    return sph_case_start(c, NULL);
}

static struct sph *tank(struct sph_case *c, int n, double x[][2])
{
    return tank_with(c, NULL, n, x);
}

static int joints_with(double (*bed)[2], int n, double x[][2])
{
    struct sph_case c;
    struct wall_joints found = {0};
    wall_joints_find(tank_with(&c, bed, n, x), &found);
    const int joints = found.n;
    FREE(found.of);
    DROP(c.s);
    return joints;
}

static int joints_of(int n, double x[][2]) { return joints_with(NULL, n, x); }

/* A body over the toe of a bed, whose faces lie on floor and bed, or the same upside down: there is
 * no fluid at the toe, whatever the last digits of the slopes make of which face comes first. */
TEST(no_fluid_is_at_the_toe_of_a_bed_under_a_body)
{
    for (int k = 0; k < 80; k++) {
        const double slope = 0.05 * (k / 4 + 1),
                     up = 0.2 * slope * (1.0 + (k % 2 ? 1e-12 : -1e-12));
        double bed[2][2] = {{0.5, 0.0}, {1.0, 0.5 * slope}};
        double body[5][2] = {{0.45, 0.0}, {0.45, 0.4}, {0.7, 0.4}, {0.7, up}, {0.5, 0.0}};
        for (int i = 0; i < 5 && k / 2 % 2; i++)
            for (int a = 0; a < 2; a++) {
                body[i][a] = 1.0 - body[i][a];
                if (i < 2)
                    bed[i][a] = 1.0 - bed[i][a];
            }
        assert_int_equal(joints_with(bed, 5, body), 0);
    }
}

TEST(walls_that_part_are_found)
{
    const double far = 0.2 / CELLS; /* in which water may pass */
    assert_int_equal(joints_of(3, (double[][2]){{0.5, 0.0}, {0.4, 0.9}, {0.6, 0.9}}),
                     1); /* on its tip */
    assert_int_equal(joints_of(3, (double[][2]){{0.5, far}, {0.4, 0.9}, {0.6, 0.9}}), 0);
    assert_int_equal(joints_of(4, (double[][2]){{0.3, 0.0}, {0.3, 0.3}, {0.7, 0.3}, {0.7, 0.0}}),
                     0); /* flat */
    assert_int_equal(joints_of(4, (double[][2]){{0.3, 0.3}, {0.3, 0.7}, {0.7, 0.7}, {0.7, 0.3}}),
                     0);
    assert_int_equal(joints_of(3, (double[][2]){{0.0, 0.5}, {0.5, 0.9}, {0.5, 0.1}}),
                     1); /* beside a side */
}

/* Beside the tip of a wedge those on one side see each other and not the others; over its top they
 * do. */
TEST(nobody_sees_through)
{
    struct sph_case c;
    struct wall_joints found = {0};
    wall_joints_find(tank(&c, 3, (double[][2]){{0.5, 0.0}, {0.4, 0.6}, {0.6, 0.6}}), &found);
    assert_int_equal(found.n, 1);
    const struct wall_joint *j = found.of;
    const double left[2] = {0.45, 0.02}, low[2] = {0.3, 0.01}, right[2] = {0.54, 0.05};
    assert_int_equal(j->nfluids, 2);
    assert_int_equal(wall_joint_fluid(j, left), wall_joint_fluid(j, low));
    assert_int_not_equal(wall_joint_fluid(j, left), wall_joint_fluid(j, right));
    assert_false(wall_joint_hides(j, left, low));
    assert_true(wall_joint_hides(j, left, right));
    assert_true(wall_joint_hides(j, right, low));
    assert_false(wall_joint_hides(j, (double[2]){0.35, 0.65}, (double[2]){0.65, 0.65}));
    assert_true(wall_joint_parts(j, left, c.s->R));
    assert_false(wall_joint_parts(j, low, 0.1));
    FREE(found.of);
    DROP(c.s);
}

/* Beside the top of a square that stands on its corner the water is one again. */
TEST(fluids_meet_over_a_small_body)
{
    struct sph_case c;
    struct wall_joints found = {0};
    wall_joints_find(tank(&c, 4, (double[][2]){{0.5, 0.0}, {0.3, 0.2}, {0.5, 0.4}, {0.7, 0.2}}),
                     &found);
    assert_int_equal(found.n, 1);
    const struct wall_joint *j = found.of;
    for (int side = -1; side <= 1; side += 2) {
        assert_true(wall_joint_parts(j, (double[2]){0.5 + side * 0.05, 0.02}, c.s->R));
        assert_false(wall_joint_parts(j, (double[2]){0.5 + side * 0.05, 0.38}, c.s->R));
    }
    FREE(found.of);
    DROP(c.s);
}

/* Of a symmetric scene. */
static double gamma_of_mirror(const struct sph *s, const double *gamma, const double *x)
{
    for (int i = 0; i < s->p.n; i++) {
        const double *y = prim_line(&s->p, i);
        if (fabs(x[0] + y[0] - 1.0) < 1e-9 && fabs(x[1] - y[1]) < 1e-9)
            return gamma[i];
    }
    return NAN;
}

/* The floor on either side of a tip is its own water's alone: the first half of its segment as well
 * as the second. */
TEST(sides_of_a_tip_are_mirrors)
{
    struct sph_case c;
    double worst = 0.0;
    struct sph *s = tank(&c, 3, (double[][2]){{0.5, 0.0}, {0.3, 0.35}, {0.7, 0.35}});
    double *gamma = sph_case_gammas(s);
    for (int i = 0; i < s->p.n; i++)
        if (hypot(prim_line(&s->p, i)[0] - 0.5, prim_line(&s->p, i)[1]) < 0.2)
            worst = fmax(worst, fabs(gamma_of_mirror(s, gamma, prim_line(&s->p, i)) - gamma[i]));
    assert_close(worst, 0.0, 1e-12);
    mem_free(gamma);
    DROP(c.s);
}

/* A driven tip that leaves the floor opens it, one that comes down closes it. */
TEST(joints_come_and_go)
{
    struct sph_case c;
    struct wall_joints found = {0};
    struct sph *s = tank(&c, 3, (double[][2]){{0.5, 0.0}, {0.4, 0.9}, {0.6, 0.9}});
    s->walls->bodies[0].moves = true;
    for (int up = 0; up < 3; up++) {
        for (int k = s->walls->bodies[0].first; k < s->walls->nsegments; k++)
            s->walls->segments[k].a[1] += up == 1 ? 0.1 : up == 2 ? -0.1 : 0.0;
        for (int k = s->walls->bodies[0].first; k < s->walls->nsegments; k++)
            s->walls->segments[k].b[1] += up == 1 ? 0.1 : up == 2 ? -0.1 : 0.0;
        wall_joints_find(s, &found);
        assert_int_equal(found.n, up == 1 ? 0 : 1);
    }
    FREE(found.of);
    DROP(c.s);
}
