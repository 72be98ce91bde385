/* test_wedges.c - what bodies at rest get where no particle fits before a wall: which have such
 * places, that the wall gets the opposite, and what bodies beside them change.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/bodies/body_seal.h"
#include "../../../sph/refinement/apr_params.h"
#include "sph_case.h"

enum { CELLS = 20, CORNERS = 32 };

static const double depth = 0.8, radius = 0.2;

/* A tank of 1 m, dx 0.05 m, and a disc whose lowest corner is `low', m, above the floor, or a block
 * on it. */
static struct scene *scene_of(struct sph_case *c, int cells, double low, bool block, int packing)
{
    static const double box[4][2] = {{0.3, 0.0}, {0.3, 0.4}, {0.7, 0.4}, {0.7, 0.0}};
    struct scene *e = sph_case_tank(c, cells, 9.81, 3);
    e->initial.level = 0.0;
    e->nshapes = 1;
    e->shapes[0] = (struct scene_shape){.form = SHAPE_BELOW, .level = depth};
    e->nbodies = 1;
    e->bodies[0].points.n = block ? 4 : CORNERS;
    for (int k = 0; k < e->bodies[0].points.n; k++) {
        double *x = e->bodies[0].points.x[k];
        x[0] = block ? box[k][0] : 0.5 - radius * sin(2.0 * M_PI * k / CORNERS);
        x[1] = block ? box[k][1] : low + radius * (1.0 - cos(2.0 * M_PI * k / CORNERS));
    }
    c->prm.scheme = SCHEME_RIEMANN;
    c->prm.surface = true;
    c->prm.c0 = 40.0;
    c->prm.packing = packing;
    return e;
}

static struct sph *tank_of(struct sph_case *c, int cells, double low, bool block, int packing)
{
    scene_of(c, cells, low, block, packing);
    return sph_case_start(c, NULL);
}

static struct sph *tank(struct sph_case *c, double low, bool block)
{
    return tank_of(c, CELLS, low, block, 0);
}

/* The force on the body of what is added alone, and on the walls. */
static void press(struct sph *s, double body[2], double walls[2])
{
    integrate_gradients(s);
    forces_clear(s->walls);
    body_seals_add(s);
    memcpy(body, s->walls->forces.stage[0].F, 2 * sizeof *body);
    memcpy(walls, s->walls->forces.stage[BODIES_MAX].F, 2 * sizeof *walls);
}

/* Where a disc stands the water below it bears it: by no more than its pressure on the floor over
 * the width above which the gap is 3 dx. */
TEST(disc_on_the_floor_is_borne)
{
    struct sph_case c;
    double on[2], back[2];
    struct sph *s = tank(&c, 0.0, false);
    const double gap = 3.0 / CELLS, width = 2.0 * sqrt(gap * (2.0 * radius - gap));
    press(s, on, back);
    assert_true(s->walls->rest[0]->n > 0);
    assert_true(on[1] > 0.0 && on[1] < 9.81 * depth * width);
    assert_close(on[0] + back[0], 0.0, 1e-12);
    assert_close(on[1] + back[1], 0.0, 1e-12);
    DROP(c.s);
}

/* No water is below a block on the floor; a disc above it has particles all round. Neither asks. */
TEST(others_have_none)
{
    struct sph_case c;
    assert_false(tank(&c, 0.0, true)->walls->wedged[0]);
    DROP(c.s);
    assert_false(tank(&c, 4.0 / CELLS, false)->walls->wedged[0]);
    DROP(c.s);
}

static void set_box(struct scene_body *b, double x0, double y0, double x1, double y1)
{
    const double at[4][2] = {{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}};
    b->points.n = 4;
    for (int k = 0; k < 4; k++)
        memcpy(b->points.x[k], at[k], sizeof at[k]);
}

/* A box stands beside the disc, its face in the wedge below it, and goes away: what the disc has
 * in common with the water is then what it is without the box. */
TEST(what_leaves_a_wedge_gives_way)
{
    struct sph_case c, alone;
    double on[2], back[2];
    struct scene *e = scene_of(&c, CELLS, 0.0, false, 0);
    set_box(&e->bodies[e->nbodies++], 0.73, 0.08, 0.9, 0.25);
    e->bodies[1].velocity[1] = 0.4;
    struct sph *s = sph_case_start(&c, NULL), *free = tank(&alone, 0.0, false);
    press(free, on, back);
    const struct seal_rest *of = free->walls->rest[0];
    for (int part = 0; part < 3; part++) {
        double less = 0.0;
        walls_move(s, part * 1.0);
        press(s, on, back);
        const struct seal_rest *now = s->walls->rest[0];
        assert_int_equal(now->n, of->n);
        for (int k = 0; k < of->n; k++)
            less = fmax(less, of->of[k].room - now->of[k].room);
        assert_true(part == 0 ? less > 0.05 : less < 1e-12);
    }
    DROP(c.s);
    DROP(alone.s);
}

/* A block stands on the disc. While nothing moves it is the same whether the block is free: places
 * that are sealed for both reasons are pressed once. */
TEST(stack_on_the_floor_is_pressed_once)
{
    double on[2][2], back[2];
    for (int free = 0; free < 2; free++) {
        struct sph_case c;
        struct scene *e = scene_of(&c, CELLS, 0.0, false, 0);
        set_box(&e->bodies[e->nbodies++], 0.3, 0.4, 0.7, 0.6);
        e->bodies[1].free = free;
        e->bodies[1].density = 2.0;
        press(sph_case_start(&c, NULL), on[free], back);
        DROP(c.s);
    }
    assert_true(on[0][1] > 0.0);
    assert_close(on[1][1], on[0][1], 1e-3 * on[0][1]); /* a free one is moved off by 0.002 dx */
}

static int flowing(const struct sph *s)
{
    int n = 0;
    for (int i = 0; i < s->p.n; i++)
        n += !particles_is_guard(&s->p, i);
    return n;
}

/* All water is refined: the places are the finer level's, which fills the wedges, as in a tank of
 * its spacing, and both levels' walls know the step. */
TEST(finer_levels_know_wedges)
{
    struct sph_case c;
    struct diagnosis d = {0};
    const int fine = tank_of(&c, 2 * CELLS, 0.0, false, 40)->p.n;
    DROP(c.s);
    apr_given = (struct apr_params){.levels = 1, .margin = 3.0, .regions.n = 1};
    apr_given.regions.of[0] =
        (struct apr_region){.level = 1, .min = {-1.0, -1.0, -1.0}, .max = {2.0, 2.0, 2.0}};
    struct sph *s = tank_of(&c, CELLS, 0.0, false, 40);
    apr_given = (struct apr_params){0};
    integrate_step(s, 1.0, &d);
    assert_int_equal(flowing(s), 0);
    assert_close(flowing(s->finer), fine, 0.015 * fine); /* 2 % less with empty wedges */
    assert_true(s->dt > 0.0 && s->finer->dt == s->dt);
    const struct seal_rest *rest = s->walls->rest[0];
    assert_true(rest->n > 0);
    for (int k = 0; k < rest->n; k++) {
        assert_int_equal(rest->of[k].level, 1);
        assert_true(rest->of[k].is.area <= 0.26 * c.prm.dx);
    }
    DROP(c.s);
}

/* Of a plane floor: half of the kernel on it, nothing from R on; in the corner with a side three
 * quarters; and as much from a place just behind it. */
TEST(shares_of_planes)
{
    struct sph_case c;
    struct sph *s = tank(&c, 4.0 / CELLS, false);
    const double e = 1e-9, R = s->R;
    assert_close(wall_share(s, -1, (const double[3]){0.5, e}), 0.5, 1e-6);
    assert_close(wall_share(s, -1, (const double[3]){0.5, -e}), 0.5, 1e-6);
    assert_close(wall_share(s, -1, (const double[3]){0.5, R}), 0.0, 1e-12);
    assert_close(wall_share(s, -1, (const double[3]){e, e}), 0.75, 1e-6);
    DROP(c.s);
}

/* Forces of pairs on either side of a slit of height h, of p at their middle, are those of p at the
 * upper face and rho g h/2 more for both: over the kernel's part behind the floor, g h times it. */
TEST(weight_in_a_slit)
{
    struct sph_case c;
    struct sph *s = tank(&c, 0.0, true);
    for (int k = 1; k < 8; k++) {
        const double h = k * s->R / 10.0, x[3] = {0.5, h, 0.0}, up[3] = {0.0, 1.0, 0.0};
        double out[3] = {0.0, 0.0, 0.0};
        wall_share_weight(s, -1, x, up, out);
        const double want = 9.81 * h * wall_share(s, -1, x);
        assert_close(out[0], 0.0, 1e-9);
        assert_true(fabs(out[1] - want) < 0.01 * 9.81 * s->R * 0.1);
    }
    DROP(c.s);
}
