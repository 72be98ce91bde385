/* test_wave_field.c - waves that evolve: of second order in their steepness they are what theory
 * says, and differ from it by the third; water stays at its surface, and its velocities have no
 * divergence and no rotation above and below the layer; the same bits whoever asks when, zones that
 * share a field too. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/waves/sea.h"
#include "../../../common/waves/second_order.h"
#include "../../../common/waves/wave_field.h"

static void below(double value, double bound, const char *what)
{
    print_message("%s: %.3g (at most %.2g)\n", what, value, bound);
    assert_true(value <= bound);
}

static struct wave_spec spec(int kind, double height, double depth, int evolve)
{
    return (struct wave_spec){.kind = kind,
                              .height = height,
                              .length = 1.0,
                              .depth = depth,
                              .g = 9.81,
                              .rho = 1000.0,
                              .peak = 3.3,
                              .seed = 1,
                              .repeat = 8.0,
                              .evolve = evolve,
                              .window = {{0.0, 1.0}, {0.0, 0.0}}};
}

/* Largest level of the group, of its sum of first and second order, and of their difference, around
 * the focus. */
static void compare(double height, double depth, int evolve, double *first, double *second)
{
    struct wave_spec of = spec(WAVE_FOCUSED, height, depth, evolve);
    double nodes[WAVE_NODES];
    of.at[0] = 0.5;
    of.at[1] = 1.0;
    struct waves *w = waves_create(&of);
    for (int j = 0; j < WAVE_NODES; j++)
        nodes[j] = -depth * j / (WAVE_NODES - 1);
    struct second_order *bound =
        second_order_create(w->ncomponents, w->components, of.g, depth, nodes, false);
    *first = *second = 0.0;
    for (int k = -10; k <= 10; k++) {
        const double t = of.at[1] + 0.05 * k * w->period, x = of.at[0];
        double linear = 0.0, more = 0.0, u[2 * WAVE_NODES] = {0.0};
        waves_at(w, t);
        for (int c = 0; c < w->ncomponents; c++)
            linear += w->components[c].a *
                      cos(w->components[c].k * x - w->components[c].w * t + w->components[c].phase);
        second_order_add(bound, t, x, 0.0, 1, &more, u);
        *first = fmax(*first, fabs(waves_eta(w, x, 0.0) - linear));
        *second = fmax(*second, fabs(waves_eta(w, x, 0.0) - linear - more));
    }
    FREE(bound, w);
}

/* What the sum of second order leaves falls as the cube of the height, what the first leaves as its
 * square. */
TEST(groups_are_of_second_order)
{
    static const double depths[] = {4.0, 0.2};
    for (int d = 0; d < (SANITIZED ? 0 : 2); d++)
        for (int evolve = d ? EVOLVE_HOS : EVOLVE_FULL; evolve <= EVOLVE_HOS; evolve++) {
            double one[2], two[2];
            for (int k = 0; k < 2; k++)
                compare(k ? 0.001 : 0.002, depths[d], evolve, one + k, two + k);
            print_message("depth %g: first %.3g %.3g, second %.3g %.3g\n", depths[d], one[0],
                          one[1], two[0], two[1]);
            assert_close(log2(one[0] / one[1]), 2.0, 0.3);
            assert_close(log2(two[0] / two[1]), 3.0, 0.5);
        }
}

/* d eta/dt + u d eta/dx + v d eta/dy = w on the surface, div u = rot u = 0 at some depths. */
static void check_water(const struct wave_spec *of, double t0, int places, const char *what)
{
    struct waves *w = waves_create(of);
    const double e = 0.004, T = w->period;
    double worst[3] = {0.0};
    for (int i = 0; i < places; i++) {
        const double x = 0.1 + 0.17 * i, y = of->spread > 0.0 ? 0.1 : 0.0, t = (t0 + 0.11 * i) * T;
        double u[3], d[3][2][3], eta[2];
        for (int k = 0; k < 2; k++) {
            waves_at(w, t + (k ? e : -e) * T);
            eta[k] = waves_eta(w, x, y);
        }
        waves_at(w, t);
        const double z = waves_eta(w, x, y),
                     ex = (waves_eta(w, x + e, y) - waves_eta(w, x - e, y)) / (2.0 * e),
                     ey = (waves_eta(w, x, y + e) - waves_eta(w, x, y - e)) / (2.0 * e);
        waves_velocity(w, x, y, z, u);
        worst[0] = fmax(worst[0], fabs((eta[1] - eta[0]) / (2.0 * e * T) +
                                       (u[0] - w->current) * ex + u[2] * ey - u[1]));
        const double at = z - 0.01 - 0.18 * i * fmin(of->depth, 0.6);
        for (int k = 0; k < 2; k++) {
            const double way = k ? e : -e;
            waves_velocity(w, x + way, y, at, d[0][k]);
            waves_velocity(w, x, y, at + way, d[1][k]);
            waves_velocity(w, x, y + way, at, d[2][k]);
        }
        const double div = d[0][1][0] - d[0][0][0] + d[1][1][1] - d[1][0][1] + d[2][1][2] -
                           d[2][0][2],
                     rot = d[0][1][1] - d[0][0][1] - d[1][1][0] + d[1][0][0];
        worst[1] = fmax(worst[1], fabs(div) / (2.0 * e));
        worst[2] = fmax(worst[2], fabs(rot) / (2.0 * e));
    }
    print_message("%s, %d components; ", what, w->ncomponents);
    below(worst[0] / w->speed, 0.01, "surface");
    below(worst[1] / (w->speed * 2.0 * M_PI / w->length), 0.02, "divergence");
    below(worst[2] / (w->speed * 2.0 * M_PI / w->length), 0.02, "rotation");
    FREE(w);
}

TEST(water_stays_water)
{
    struct wave_spec of = spec(WAVE_SEA, 0.03, 3.0, EVOLVE_FULL);
    check_water(&of, SANITIZED ? -7.9 : -6.0, SANITIZED ? 1 : 5, "deep sea");
    if (SANITIZED)
        return;
    of.closed = true;
    of.evolve = EVOLVE_HOS;
    of.depth = 0.3;
    check_water(&of, -6.0, 5, "sea by orders over 0.3 m");
    of.height = 0.02;
    of.repeat = 4.5;
    of.spread = 10.0;
    of.window[1][1] = 1.0;
    check_water(&of, -7.9, 1, "sea of several directions");
}

TEST(bits_do_not_depend_on_who_asks)
{
    struct wave_spec of = spec(WAVE_FOCUSED, 0.04, 0.5, EVOLVE_FULL);
    of.zone = 1.0;
    of.rate = 20.0;
    of.normal[0] = 1.0;
    struct waves *one = waves_create(&of), *other = waves_create(&of), *third = waves_create(&of);
    /* two periods after the start: 120 steps */
    const double t = (SANITIZED ? -7.7 : -6.0) * one->period;
    double u[3], v[3];
    waves_share(third, one);
    for (int i = 0; i < 9; i++)
        waves_at(one, t + 0.02 * i);
    waves_at(other, t + 0.5);
    waves_at(other, t + 0.1);
    waves_at(third, t + 0.13);
    waves_at(third, t + 0.1);
    waves_at(one, t + 0.1);
    waves_velocity(one, 0.7, 0.0, -0.1, u);
    waves_velocity(other, 0.7, 0.0, -0.1, v);
    assert_memory_equal(u, v, sizeof u);
    waves_velocity(third, 0.7, 0.0, -0.1, v);
    assert_memory_equal(u, v, sizeof u);
    /* from a state that was kept it need not evolve from its start */
    struct waves *last = waves_create(&of);
    int slot = 0;
    for (int k = 0; k < WAVE_FIELD_KEPT; k++)
        slot = one->field->kept[k] < one->field->kept[slot] ? k : slot;
    wave_field_set(last->field, one->field->kept[slot], one->field->states[slot], 0.0);
    waves_at(last, t + 0.1);
    waves_velocity(last, 0.7, 0.0, -0.1, v);
    assert_memory_equal(u, v, sizeof u);
    assert_true(SANITIZED || last->field->of->products < one->field->of->products / 10);
    FREE(last, third, one, other);
}
