/* test_windows.c - what sets the windows of a coupled job: sound that a box of particles open at
 * its top alone cannot let go. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/coupling/windows.h"
#include "sph_case.h"

/* Water 0.7 deep between walls, a box on its floor, `height' with its zones, from wall to wall, or
 * ending before one. */
static struct windows windows_over(double height, double width, double gravity)
{
    struct sph_case c;
    sph_case_set(&c, 2, 80);
    struct scene *s = &c.run.scene;
    const bool down = gravity < 0.0;
    s->fluid.nu = 0.0;
    s->fluid.gravity[1] = gravity;
    s->initial.field = FIELD_UNIFORM;
    s->initial.velocity[0] = 0.2;
    s->initial.level = down ? 0.7 : -0.3;
    s->domain.max[0] = 2.0;
    s->domain.periodic[0] = s->domain.periodic[1] = false;
    s->nwalls = 4;
    for (int k = 0; k < 4; k++)
        s->walls[k] = (struct scene_wall){.side = SIDE_X_MIN + k, .kind = WALL_SLIP};
    s->time.end = 1.0;
    s->has_fv = s->has_sph = true;
    c.run.coupled = c.run.crossed = true;
    c.prm.c0 = 27.0;
    c.prm.box[0][1] = down ? 0.0 : 1.0 - height;
    c.prm.box[1][0] = width;
    c.prm.box[1][1] = down ? height : 1.0;
    c.prm.outer = OUTER_PARTNER;
    return windows_choose(&c.run, &c.prm);
}

/* Lowest root w of w tan(w h/c) = c/over: water as a spring, h high, under water as a mass. */
static double frequency(double h, double over, double c)
{
    double lo = 0.0, hi = 0.5 * M_PI;
    for (int k = 0; k < 60; k++) {
        const double mid = 0.5 * (lo + hi);
        *(mid * tan(mid) < h / over ? &lo : &hi) = mid;
    }
    return lo * c / h;
}

TEST(sound_in_a_cup_is_followed)
{
    for (int k = 0; k < 4; k++) {
        const double height = 0.3 + 0.1 * (k / 2), gravity = k % 2 ? 9.81 : -9.81;
        const struct windows w = windows_over(height, 2.0, gravity);
        const double wT = frequency(height, 0.7 - height, 27.0) * w.T;
        print_message("windows of %d steps, %g of a radian of its sound\n", w.steps, wT);
        assert_true(wT < 0.55 && wT > 0.35);
        assert_true(w.gain * windows_smoothed(w.memory) < 0.45);
        assert_true(windows_over(height, 1.5, gravity).T > 1.5 * w.T); /* a side lets it go */
    }
}

/* What stands up to the roof beside the box, from x = 0.4 m to `end', with the floor at either side
 * of the domain. */
TEST(water_under_a_roof_moves_as_one)
{
    for (int k = 0; k < 2; k++) {
        struct sph_case c;
        sph_case_set(&c, 2, 80);
        struct scene *s = &c.run.scene;
        s->fluid.gravity[1] = k ? 9.81 : -9.81;
        s->domain.max[0] = 2.0;
        s->domain.periodic[0] = s->domain.periodic[1] = false;
        s->nwalls = 4;
        for (int side = 0; side < 4; side++)
            s->walls[side] = (struct scene_wall){.side = SIDE_X_MIN + side, .kind = WALL_SLIP};
        s->nshapes = 2;
        s->shapes[0] =
            (struct scene_shape){.form = SHAPE_BOX, .box = {{0, 0.6 * k}, {2, 0.4 + 0.6 * k}}};
        s->shapes[1] = (struct scene_shape){.form = SHAPE_BOX, .box = {{0.4, 0}, {1.5, 1}}};
        c.run.crossed = true;
        c.prm.box[0][0] = 0.8;
        c.prm.box[1][0] = 1.2;
        assert_close(windows_roofed(&c.run, &c.prm, 0), 0.4, 2.0 * c.prm.dx);
        assert_close(windows_roofed(&c.run, &c.prm, 1), 0.3, 2.0 * c.prm.dx);
        assert_close(windows_roofed(&c.run, &c.prm, 2), 0.0, 0.0);
        s->shapes[1].box[1][0] = 2.0;
        assert_true(isinf(windows_roofed(&c.run, &c.prm, 1))); /* as far as the wall */
        s->walls[1].kind = WALL_OUTFLOW;
        assert_close(windows_roofed(&c.run, &c.prm, 1), 0.8, 2.0 * c.prm.dx);
        s->walls[1].kind = WALL_SLIP;
        c.prm.box[1][0] = 2.0; /* the box reaches it */
        assert_close(windows_roofed(&c.run, &c.prm, 1), 0.0, 0.0);
    }
}

/* A stream carried by `velocity' in a channel of 2 m, all of it in units `length' times as long. */
static struct windows stream(double length, double velocity)
{
    struct sph_case c;
    sph_case_set(&c, 2, 40);
    struct scene *s = &c.run.scene;
    s->fluid.nu = 0.0;
    s->fluid.gravity[1] = -9.81 * length;
    s->initial.field = FIELD_UNIFORM;
    s->initial.velocity[0] = velocity * length;
    s->initial.level = 0.7 * length;
    s->domain.max[0] = 2.0 * length;
    s->domain.max[1] = length;
    s->domain.periodic[0] = s->domain.periodic[1] = false;
    s->has_fv = s->has_sph = c.run.coupled = c.run.crossed = true;
    c.prm.dx *= length;
    c.prm.c0 = 27.0 * length;
    c.prm.box[0][0] = 0.5 * length;
    c.prm.box[1][0] = 1.5 * length;
    c.prm.box[1][1] = length;
    c.prm.outer = OUTER_PARTNER;
    return windows_choose(&c.run, &c.prm);
}

TEST(coupling_steps_know_no_unit)
{
    const struct windows w = stream(1.0, 0.4), small = stream(1.0 / 128.0, 0.4);
    assert_close(w.U, 0.4, 1e-12);
    assert_int_equal(small.steps, w.steps);
    assert_close(small.T, w.T, 1e-12 * w.T);
    assert_close(small.U, w.U / 128.0, 1e-15);
}
