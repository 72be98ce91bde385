/* test_scene_speed.c - the largest speed that a scene lets expect, against what mechanics says of
 * it; it scales with units and does not ask for initial.U where the field has none.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/scene/scene_speed.h"

/* With bodies that follow motion files taken to be at rest. */
static double speed_of(const struct scene *s) { return scene_speed_of(s, 0.0, 0.0).speed; }

/* A plane box of 2 m x 1 m, at rest, no gravity, 10 s. */
static struct scene box(void)
{
    struct scene s = {.time.end = 10.0, .fluid.rho = 1000.0, .domain.dim = 2};
    s.domain.max[0] = 2.0;
    s.domain.max[1] = 1.0;
    s.initial.U = 77.0; /* nothing to do with a scene at rest */
    s.initial.L = 1.0;
    s.initial.level = LEVEL_TOP;
    return s;
}

static struct scene column(double height)
{
    struct scene s = box();
    s.fluid.gravity[1] = -9.81;
    s.nshapes = 1;
    s.shapes[0].form = SHAPE_BOX;
    s.shapes[0].box[1][0] = 0.5;
    s.shapes[0].box[1][1] = height;
    return s;
}

/* What something keeps streaming: not what falls, nor a body that is let go with a velocity. */
TEST(a_stream_is_what_something_keeps_going)
{
    struct scene s = column(0.6);
    s.nbodies = 1;
    s.bodies[0] = (struct scene_body){.free = true, .velocity = {2.0}};
    assert_true(scene_speed_of(&s, 0.0, 0.0).stream == 0.0);
    s.bodies[0].free = false;
    assert_close(scene_speed_of(&s, 0.0, 0.0).stream, 2.0, 1e-12);
    s.nbodies = 0;
    s.initial.field = FIELD_UNIFORM;
    s.initial.velocity[0] = 0.3;
    assert_close(scene_speed_of(&s, 0.0, 0.0).stream, 0.3, 1e-12);
    s.nwalls = 1;
    s.walls[0] = (struct scene_wall){.side = SIDE_X_MIN, .kind = WALL_INFLOW, .velocity = {0.5}};
    assert_close(scene_speed_of(&s, 0.0, 0.0).stream, 0.5, 1e-12);
}

TEST(water_falls_from_its_top_to_the_bottom)
{
    struct scene s = column(0.6);
    assert_close(speed_of(&s), sqrt(2.0 * 9.81 * 0.6), 1e-12);
    assert_close(scene_speed_of(&s, 0.0, 0.0).pressure, 9.81 * 0.6, 1e-12);
    s.shapes[0] = (struct scene_shape){.form = SHAPE_DISC, .centre = {1.0, 0.7}, .radius = 0.1};
    assert_close(speed_of(&s), sqrt(2.0 * 9.81 * 0.8), 1e-12);
    s.shapes[0].velocity[1] = -3.0;
    assert_close(speed_of(&s), sqrt(2.0 * 9.81 * 0.8 + 9.0), 1e-12);
    s = column(5.0); /* cut by the domain */
    assert_close(speed_of(&s), sqrt(2.0 * 9.81), 1e-12);
}

/* Of a tank's water it is the tank's floor, wherever the domain ends; a tank that may turn can
 * bring its water into a corner. */
TEST(water_in_a_tank_falls_to_the_floor_of_the_tank)
{
    static const struct scene_body tank = {
        .tank = true, .points = {.n = 4, .x = {{0.0, 0.5}, {0.6, 0.5}, {0.6, 0.9}, {0.0, 0.9}}}};
    struct scene s = column(0.7);
    s.shapes[0].box[0][1] = 0.5;
    s.nbodies = 1;
    s.bodies[0] = tank;
    assert_close(speed_of(&s), sqrt(2.0 * 9.81 * 0.2), 1e-12);
    s.bodies[0].spin[2] = 0.1;
    const double low = 0.7 - 0.5 * hypot(0.6, 0.4);
    const double fall = 2.0 * 9.81 * (0.7 - low);
    assert_true(speed_of(&s) > sqrt(fall) - 1e-12 && speed_of(&s) < sqrt(fall) + 0.1);
    s.bodies[0].tank = false;
    s.bodies[0].spin[2] = 0.0;
    assert_close(speed_of(&s), sqrt(2.0 * 9.81 * 0.7), 1e-12);
}

TEST(a_column_scales_with_its_units)
{
    struct scene s = column(0.6), small = s;
    for (int a = 0; a < 2; a++) {
        small.domain.max[a] *= 1e-3;
        small.shapes[0].box[1][a] *= 1e-3;
    }
    assert_close(speed_of(&small) / speed_of(&s), sqrt(1e-3), 1e-12);
}

/* Between plates p = 12 nu U L/h^2 holds the stream back, whichever axis it flows along. */
TEST(a_channel_holds_its_stream_back)
{
    struct scene s = box(); /* 2 m along x */
    s.fluid.nu = 0.1;
    s.nwalls = 4;
    for (int k = 0; k < 4; k++)
        s.walls[k] = (struct scene_wall){.side = SIDE_X_MIN + k, .kind = WALL_NO_SLIP};
    s.walls[0].kind = WALL_INFLOW;
    s.walls[1].kind = WALL_OUTFLOW;
    s.walls[0].velocity[0] = 3.0;
    s.walls[0].profile = PROFILE_PARABOLIC; /* of mean 2 */
    assert_close(scene_speed_of(&s, 0.0, 0.0).viscous, 12.0 * 0.1 * 2.0 * 2.0, 1e-12);
    s.walls[3].kind = WALL_SLIP; /* half of a channel of twice the width */
    assert_close(scene_speed_of(&s, 0.0, 0.0).viscous, 3.0 * 0.1 * 2.0 * 2.0, 1e-12);
    s.walls[2].kind = WALL_SLIP; /* nothing but the stream's own length */
    assert_close(scene_speed_of(&s, 0.0, 0.0).viscous, 0.1 * 3.0 / 1.0, 1e-12);
}

TEST(water_below_one_level_does_not_fall)
{
    struct scene s = box();
    s.fluid.gravity[1] = -9.81;
    s.nshapes = 1;
    s.shapes[0] = (struct scene_shape){.form = SHAPE_BELOW, .level = 0.5};
    const struct scene_speed v = scene_speed_of(&s, 0.0, 0.0);
    assert_false(v.moves);
    assert_close(v.speed, sqrt(9.81 * 0.5), 1e-12);
    s.nshapes = 2; /* a hole in it: the rest falls in */
    s.shapes[1] = (struct scene_shape){.form = SHAPE_BOX, .hole = true, .box = {{1, 0}, {2, 1}}};
    assert_close(speed_of(&s), sqrt(2.0 * 9.81 * 0.5), 1e-12);
}

TEST(a_closed_full_tank_has_its_static_pressure)
{
    struct scene s = box();
    s.fluid.gravity[1] = -9.81;
    assert_close(speed_of(&s), sqrt(9.81), 1e-12);
    assert_false(scene_speed_of(&s, 0.0, 0.0).moves);
    s.fluid.gravity[1] = 0.0; /* nothing at all: 2 m in 10 s */
    assert_close(speed_of(&s), 0.2, 1e-12);
}

TEST(what_carries_a_field_counts)
{
    struct scene s = box();
    s.initial.field = FIELD_TAYLOR_GREEN;
    s.initial.U = 1.0;
    s.initial.velocity[0] = 3.0;
    s.initial.velocity[1] = 4.0;
    assert_close(speed_of(&s), 6.0, 1e-12);
    s.initial.field = FIELD_UNIFORM; /* U is a unit of errors only */
    assert_close(speed_of(&s), 5.0, 1e-12);
    s.initial.field = FIELD_REST;
    s.nshapes = 1;
    s.shapes[0].velocity[0] = -2.0;
    assert_close(speed_of(&s), 2.0, 1e-12);
}

TEST(walls_bodies_and_inlets_count)
{
    struct scene s = box();
    s.nwalls = 1;
    s.walls[0] = (struct scene_wall){.side = SIDE_Y_MAX, .kind = WALL_NO_SLIP, .velocity = {4.0}};
    assert_close(speed_of(&s), 4.0, 1e-12);
    s.nwalls = 2; /* 1 m of inlet into 1 m of outlet: the mean of 3 m/s, a profile at most */
    s.walls[0] = (struct scene_wall){.side = SIDE_X_MIN, .kind = WALL_INFLOW, .velocity = {3.0}};
    s.walls[1] = (struct scene_wall){.side = SIDE_X_MAX, .kind = WALL_OUTFLOW};
    assert_close(speed_of(&s), 4.5, 1e-12);
    s.walls[0].profile = PROFILE_PARABOLIC;
    assert_close(speed_of(&s), 3.0, 1e-12);
    s.nwalls = 0;
    s.nbodies = 1;
    s.bodies[0].points.n = 1;
    s.bodies[0].points.x[0][0] = 0.5;
    s.bodies[0].spin[2] = -2.0;
    s.bodies[0].velocity[1] = 1.0;
    assert_close(speed_of(&s), 2.0, 1e-12);
    assert_close(scene_speed_of(&s, 7.0, 0.0).speed, 7.0, 1e-12);
    /* a free body turns about its own middle, wherever it is */
    s.bodies[0].free = true;
    s.bodies[0].density = 500.0;
    s.bodies[0].points.n = 2;
    s.bodies[0].points.x[0][0] = 30.0;
    s.bodies[0].points.x[1][0] = 33.0;
    assert_close(speed_of(&s), 4.0, 1e-12);
}

TEST(a_force_along_a_periodic_axis_meets_friction_or_the_end)
{
    struct scene s = box();
    s.domain.periodic[0] = true;
    s.fluid.gravity[0] = 0.8;
    s.fluid.nu = 0.1;
    assert_close(speed_of(&s), 8.0, 1e-12); /* g t: nothing holds it */
    s.nwalls = 2;
    s.walls[0] = (struct scene_wall){.side = SIDE_Y_MIN, .kind = WALL_NO_SLIP};
    s.walls[1] = (struct scene_wall){.side = SIDE_Y_MAX, .kind = WALL_NO_SLIP};
    assert_close(speed_of(&s), 1.0, 1e-12); /* Poiseuille: g h^2/(8 nu) */
    s.nwalls = 1;
    assert_close(speed_of(&s), 4.0, 1e-12); /* a film: g h^2/(2 nu) */
    s.time.end = 0.5;
    assert_close(speed_of(&s), 0.4, 1e-12);
}

TEST(outlets_of_unequal_pressure_make_a_jet)
{
    struct scene s = box();
    s.nwalls = 2;
    s.walls[0] = (struct scene_wall){.side = SIDE_X_MIN, .kind = WALL_OUTFLOW, .pressure = 2000.0};
    s.walls[1] = (struct scene_wall){.side = SIDE_X_MAX, .kind = WALL_OUTFLOW};
    assert_close(speed_of(&s), 2.0, 1e-12); /* sqrt(2 dp/rho) */
    assert_close(scene_speed_of(&s, 0.0, 0.0).pressure, 2.0, 1e-12);
    /* pressures that balance the weight drive nothing, whatever rounding leaves of them */
    s.fluid.gravity[0] = -9.81;
    for (int k = 1; k < 20; k++) {
        s.domain.max[0] = s.domain.min[0] + 0.1 * k;
        s.walls[0].pressure = 981.0 * k;
        assert_close(speed_of(&s), fmax(0.1, 0.01 * k), 1e-12); /* length over time.end */
    }
}

TEST(waves_fall_from_crest_to_trough)
{
    struct scene s = box();
    s.domain.periodic[0] = true;
    s.fluid.gravity[1] = -1.0;
    s.initial.field = FIELD_STANDING_WAVE;
    s.initial.L = 2.0;
    s.initial.amplitude = 0.05;
    s.initial.level = 0.8;
    const double v = speed_of(&s); /* a omega of the mode, and the fall of 2 a */
    const double omega2 = M_PI * tanh(M_PI * 0.8);
    assert_close(v, sqrt(0.0025 * omega2 + 4.0 * 0.05), 1e-3);
}

/* nu U/L of Morris, Fox & Zhu (1997); to the spacing in the corners of a lid, as far as 1/k in a
 * periodic field; what falls makes none. */
TEST(slow_flows_have_the_pressure_of_friction)
{
    struct scene s = box();
    s.fluid.nu = 5.0;
    s.nwalls = 2;
    s.walls[0] = (struct scene_wall){.side = SIDE_Y_MIN, .kind = WALL_NO_SLIP};
    s.walls[1] =
        (struct scene_wall){.side = SIDE_Y_MAX, .kind = WALL_NO_SLIP, .velocity = {3.0, 0.0, 0.0}};
    assert_close(scene_speed_of(&s, 0.0, 0.0).viscous, 15.0, 1e-12);
    assert_close(scene_speed_of(&s, 0.0, 0.1).viscous, 150.0, 1e-12);
    s.domain.periodic[0] = true; /* Couette */
    assert_close(scene_speed_of(&s, 0.0, 0.1).viscous, 15.0, 1e-12);
    s.nwalls = 0;
    s.domain.periodic[1] = true;
    s.initial.field = FIELD_TWO_MODES;
    s.initial.U = 2.0;
    assert_close(scene_speed_of(&s, 0.0, 0.1).viscous, 20.0 * M_PI, 1e-12);
    s.fluid.nu = 0.0;
    assert_true(scene_speed_of(&s, 0.0, 0.1).viscous == 0.0);
    s = column(0.6);
    s.fluid.nu = 5.0;
    assert_true(scene_speed_of(&s, 0.0, 0.1).viscous == 0.0);
}

/* Half of the longest wave that stands there: a length between walls, half of a period, twice a
 * depth under a surface. */
TEST(longest_wave_of_sound)
{
    struct scene s = box();
    assert_close(scene_speed_of(&s, 0.0, 0.0).across, 2.0, 1e-12);
    s.domain.periodic[0] = true;
    assert_close(scene_speed_of(&s, 0.0, 0.0).across, 1.0, 1e-12);
    s = column(0.6);
    assert_close(scene_speed_of(&s, 0.0, 0.0).across, 1.2, 1e-12);
    s = box();
    s.nwalls = 1;
    s.walls[0] = (struct scene_wall){.side = SIDE_X_MAX, .kind = WALL_ABSORBING};
    assert_true(scene_speed_of(&s, 0.0, 0.0).across == 0.0);
}

/* Still water has the same speed, none but by its weight, whether it is drawn in one box or in
 * several, in a tank of sides or of a line, which stands in a larger domain. */
TEST(still_water_is_so_however_it_is_drawn)
{
    struct scene s = column(0.6);
    s.shapes[0].box[1][0] = 2.0;
    assert_true(strstr(scene_speed_of(&s, 0.0, 0.0).from, "static"));
    const double still = speed_of(&s);
    s.nshapes = 2;
    s.shapes[1] = s.shapes[0];
    s.shapes[0].box[1][0] = s.shapes[1].box[0][0] = 0.7; /* side by side */
    assert_close(speed_of(&s), still, 1e-12);
    s.shapes[1].box[1][1] = 0.5; /* lower */
    assert_close(speed_of(&s), sqrt(2.0 * 9.81 * 0.6), 1e-12);
    s.shapes[0] = s.shapes[1] = (struct scene_shape){.box = {{0.0, 0.0}, {2.0, 0.6}}};
    s.shapes[0].box[1][1] = s.shapes[1].box[0][1] = 0.2; /* on each other */
    assert_close(speed_of(&s), still, 1e-12);
    s.nwalls = 1;
    s.walls[0].points =
        (struct param_points){.n = 4, .x = {{0.0, 0.9}, {0.0, 0.0}, {2.0, 0.0}, {2.0, 0.9}}};
    s.domain.min[0] = s.domain.min[1] = -0.5;
    s.domain.max[0] = 2.5;
    assert_close(speed_of(&s), still, 1e-12);
    s.walls[0].closed = true;
    assert_close(speed_of(&s), still, 1e-12);
    s.shapes[0].box[1][0] = s.shapes[1].box[1][0] = 0.5; /* a column, down to the tank's floor */
    assert_close(speed_of(&s), sqrt(2.0 * 9.81 * 0.6), 1e-12);
    s.walls[0].closed = false;
    s.walls[0].points.x[3][1] = 0.3; /* it can run over that rim, and out */
    assert_close(speed_of(&s), sqrt(2.0 * 9.81 * 1.1), 1e-12);
}
