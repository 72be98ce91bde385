/* test_wall_cover.c - of walls that cross what lies behind others is left out, in random tanks;
 * walls that only touch stay as they are. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/walls/wall_cover.h"

enum { ROOM = 64 };

static const double near = 1e-3;

struct tank {
    int n;
    double ends[ROOM][2][2], lo[2], hi[2], angle;
};

static void add(struct tank *t, double ax, double ay, double bx, double by)
{
    const double c = cos(t->angle), s = sin(t->angle), x[2] = {ax, bx}, y[2] = {ay, by};
    for (int k = 0; k < 2; k++) {
        t->ends[t->n][k][0] = c * x[k] - s * y[k];
        t->ends[t->n][k][1] = s * x[k] + c * y[k];
    }
    t->n++;
}

/* Open above, 2 m wide and 1 m high; upright it is the domain, else it stands in it. */
static void tank_make(struct tank *t, bool upright)
{
    *t = (struct tank){.angle = upright ? 0.0 : random_in(0.0, 6.28)};
    for (int a = 0; a < 2; a++) {
        t->lo[a] = upright ? 0.0 : -4.0;
        t->hi[a] = upright ? (a ? 1.0 : 2.0) : 4.0;
    }
    add(t, 0.0, upright ? 1.1 : 1.0, 0.0, 0.0); /* sides go on beyond an open one */
    add(t, 0.0, 0.0, 2.0, 0.0);
    add(t, 2.0, 0.0, 2.0, upright ? 1.1 : 1.0);
}

/* Length of the walls that are left. */
static double left(const struct tank *t)
{
    double sum = 0.0;
    struct wall_parts p = wall_cover(t->n, (const double(*)[2][2])t->ends, t->lo, t->hi, near);
    for (int k = 0; k < t->n && !p.cut; k++) /* all are left */
        sum += hypot(t->ends[k][1][0] - t->ends[k][0][0], t->ends[k][1][1] - t->ends[k][0][1]);
    for (int k = 0; k < p.n; k++) {
        assert_true(p.part[k].from < p.part[k].to);
        assert_true(k == 0 || p.part[k].wall >= p.part[k - 1].wall);
        sum += p.part[k].to - p.part[k].from;
    }
    mem_free(p.part);
    return sum;
}

/* From the floor to the right side; longer by shares of it below the floor and beyond the side. */
TEST(beaches_hide_the_floor)
{
    for (int k = 0; k < 60; k++) {
        struct tank t;
        tank_make(&t, k % 2);
        const double x = random_in(0.2, 1.8), y = random_in(0.1, 0.9), l = hypot(2.0 - x, y);
        const double under = k % 3 == 1 ? random_in(0.1, 0.5) : 0.0,
                     over = k % 3 ? random_in(0.1, 0.5) : 0.0;
        const double all = k % 2 ? 4.2 : 4.0;
        add(&t, x - under * (2.0 - x), -under * y, 2.0 + over * (2.0 - x), y + over * y);
        assert_close(left(&t), all - (2.0 - x) - y + l, 1e-9);
    }
}

TEST(bumps_hide_the_floor)
{
    for (int k = 0; k < 60; k++) {
        struct tank t;
        tank_make(&t, k % 2);
        const double a = random_in(0.1, 0.9), b = random_in(1.0, 1.9), x = random_in(0.0, 2.0),
                     y = random_in(0.1, 0.9);
        const bool below = k % 3 == 0; /* begins and ends under the floor */
        const double all = k % 2 ? 4.2 : 4.0, more = below ? 0.3 : 0.0;
        add(&t, a - more * (x - a), -more * y, x, y);
        add(&t, x, y, b + more * (b - x), -more * y);
        assert_close(left(&t), all - (b - a) + hypot(x - a, y) + hypot(x - b, y), 1e-9);
    }
}

TEST(blocks_on_the_floor_have_no_bottom)
{
    for (int k = 0; k < 40; k++) {
        struct tank t;
        tank_make(&t, k % 2);
        const double a = random_in(0.1, 0.9), b = random_in(1.0, 1.9), y = random_in(0.1, 0.9);
        add(&t, a, 0.0, a, y);
        add(&t, a, y, b, y);
        add(&t, b, y, b, 0.0);
        add(&t, b, 0.0, a, 0.0);
        assert_close(left(&t), (k % 2 ? 4.2 : 4.0) + 2.0 * y, 1e-9);
    }
}

/* A bed that comes in through one open side and leaves through the other: the floor under it goes,
 * with what it has beyond both sides. */
TEST(beds_through_open_sides_hide_the_floor)
{
    for (int k = 0; k < 40; k++) {
        struct tank t = {.hi = {2.0, 1.0}};
        const double low = random_in(0.05, 0.4), high = random_in(0.05, 0.9),
                     more = random_in(0.0, 0.5);
        const double rise = high - low, beyond = random_in(0.1, 1.0);
        add(&t, -more, 0.0, 2.0 + more, 0.0);
        add(&t, -beyond, fmax(low - 0.5 * beyond * rise, 0.01), 2.0 + beyond,
            high + 0.5 * beyond * rise > 0.01 ? high + 0.5 * beyond * rise : 0.01);
        const double *a = t.ends[1][0], *b = t.ends[1][1];
        assert_close(left(&t), hypot(b[0] - a[0], b[1] - a[1]), 1e-9);
    }
}

/* A plate that stands in the fluid, a triangle that floats in it, a deck that goes on from the rim
 * (but not from a side that goes on beyond the domain). */
TEST(what_hides_nothing_stays)
{
    for (int k = 0; k < 40; k++) {
        struct tank t;
        tank_make(&t, k % 2);
        const double x = random_in(0.3, 1.7), y = random_in(0.1, 0.9);
        const double length = hypot(0.05, 0.6) + hypot(0.1, 0.3) + hypot(0.15, 0.3);
        add(&t, x, 0.0, x, y);
        add(&t, 0.1, 0.2, 0.15, 0.8);
        add(&t, 0.15, 0.8, 0.25, 0.5);
        add(&t, 0.25, 0.5, 0.1, 0.2);
        add(&t, -1.0, 1.0, 0.0, 1.0);
        assert_close(left(&t), (k % 2 ? 4.2 : 5.0) + y + length, 1e-9);
    }
}

/* Walls that meet at their ends alone. */
TEST(corners_cut_nothing)
{
    for (int k = 0; k < 20; k++) {
        struct tank t;
        tank_make(&t, k % 2);
        add(&t, 0.5, 0.2, 0.6, 0.8);
        add(&t, 0.6, 0.8, 0.9, 0.5);
        add(&t, 0.9, 0.5, 0.5, 0.2);
        const struct wall_parts p =
            wall_cover(t.n, (const double(*)[2][2])t.ends, t.lo, t.hi, near);
        assert_false(p.cut);
        assert_int_equal(p.n, 0);
    }
}

/* Behind a beach from the floor to the side, wherever the point is nearest; before it nowhere. */
TEST(rooms_behind_beaches_are_shut)
{
    for (int k = 0; k < 200; k++) {
        struct tank t;
        const double foot = random_in(0.2, 1.6), top = random_in(0.2, 0.9);
        tank_make(&t, true);
        add(&t, foot, 0.0, 2.0, top);
        const double x[2] = {random_in(0.01, 1.99), random_in(0.01, 0.99)};
        const double over = x[1] - top * (x[0] - foot) / (2.0 - foot);
        if (fabs(over) > 0.01)
            assert_int_equal(
                wall_cover_first_open(t.n, (const double(*)[2][2])t.ends, t.lo, t.hi, near, 1, &x),
                over < 0.0);
    }
}
