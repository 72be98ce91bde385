/* test_waves.c - waves that zones make: tables give what the theory gives; no net transport; a
 * given period is met; a sea has the height that was asked for and its velocities belong to its
 * surface; short crests are a sum; a group focuses; the same bits whoever asks when; what zones let
 * through by energy. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <complex.h>

#include "../../../common/scene/wave_maker.h"
#include "../../../common/waves/sea.h"
#include "../../../common/waves/sea_gains.h"
#include "../../../common/waves/zone_gain.h"

static struct wave_spec spec(int kind, double height, double length, double depth)
{
    return (struct wave_spec){.kind = kind,
                              .height = height,
                              .length = length,
                              .depth = depth,
                              .g = 9.81,
                              .rho = 1000.0,
                              .closed = true,
                              .peak = 3.3,
                              .seed = 1,
                              .repeat = 60.0,
                              .order = 1,
                              .window = {{0.0, 3.0}, {0.0, 0.0}}};
}

/* Against steady.h itself, inside and on the surface, deep and shallow; above it as on it. */
TEST(tables_give_the_wave)
{
    static const double depths[] = {0.1, 0.5, 4.0};
    for (int d = 0; d < 3; d++) {
        struct wave_spec of = spec(WAVE_REGULAR, 0.5 * waves_limit(depths[d], 1.0), 1.0, depths[d]);
        struct waves *w = waves_create(&of);
        for (int i = 0; i < 40; i++) {
            const double t = 0.037 * i, x = 0.31 * i;
            waves_at(w, t);
            const double eta = waves_eta(w, x, 0.0),
                         z = eta - 0.02 * (i % 5) * fmin(depths[d], 1.0);
            double u[3], v[3];
            waves_velocity(w, x, 0.0, z, u);
            steady_point(&w->steady, x - w->current * t, z, t, v, NULL);
            assert_close(eta, steady_eta(&w->steady, x - w->current * t, t), 1e-6);
            assert_close(u[0], v[0] + w->current, 1e-4 * w->speed);
            assert_close(u[1], v[1], 1e-4 * w->speed);
            waves_velocity(w, x, 0.0, eta + 1.0, v);
            waves_velocity(w, x, 0.0, eta, u);
            assert_memory_equal(u, v, 2 * sizeof *u);
        }
        FREE(w);
    }
}

/* At many heights of one place, from the floor to above the surface, as at each of them: regular,
 * deep, of second order, with short crests, while they grow, on a current. */
TEST(columns_are_their_points)
{
    enum { HEIGHTS = 23 };
    for (int i = 0; i < 5; i++) {
        struct wave_spec of = spec(i < 2   ? WAVE_REGULAR
                                   : i < 4 ? WAVE_SEA
                                           : WAVE_FOCUSED,
                                   0.04, i == 1 ? 0.5 : 1.0, i == 1 ? 4.0 : 0.4);
        of.order = i == 2 ? 2 : 1;
        of.spread = i == 3 ? 8.0 : 0.0;
        of.window[1][1] = 2.0;
        of.start = 4.0;
        of.current = i == 0 ? 0.2 : 0.0;
        struct waves *w = waves_create(&of);
        double z[HEIGHTS], u[HEIGHTS][3], v[3];
        for (int k = 0; k < HEIGHTS; k++)
            z[k] = -of.depth + (of.depth + 0.06) * k / (HEIGHTS - 1);
        waves_at(w, 1.3);
        waves_velocities(w, 1.234, 0.77, HEIGHTS, z, u);
        for (int k = 0; k < HEIGHTS; k++) {
            waves_velocity(w, 1.234, 0.77, z[k], v);
            for (int a = 0; a < 3; a++)
                assert_close(u[k][a], v[a], 1e-14 * w->speed);
        }
        FREE(w);
    }
}

/* Numbers of waves on a current satisfy omega = sqrt(g k tanh kh) + k U; deep water against them is
 * held from g/(4 |U|) on; the group velocity is the slope of the frequency. */
TEST(currents_change_lengths)
{
    static const double U[] = {0.3, -0.2, -0.6, 2.0};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            const double h = 0.16 * pow(10.0, j), omega = 2.0 + 0.5 * i,
                         k = waves_number_on(omega, U[i], 9.81, h), e = 1e-4 * k;
            assert_close(waves_frequency(k, 9.81, h) + k * U[i], omega, 1e-12 * omega);
            assert_close(waves_group_velocity(k, 9.81, h),
                         (waves_frequency(k + e, 9.81, h) - waves_frequency(k - e, 9.81, h)) /
                             (2.0 * e),
                         1e-7);
            assert_true(waves_group_velocity(k, 9.81, h) + U[i] > 0.0);
        }
    const double held = 9.81 / (4.0 * 0.5);
    assert_false(isnan(waves_number_on(0.999 * held, -0.5, 9.81, 100.0)));
    assert_true(isnan(waves_number_on(1.001 * held, -0.5, 9.81, 100.0)));
    assert_true(isnan(waves_number_on(1.0, -1.3, 9.81, 0.16))); /* faster than long waves */
}

/* Of one period at rest: that of still water of the length found, seen from the water. */
TEST(currents_carry_the_wave)
{
    for (int i = 0; i < 4; i += SANITIZED ? 3 : 1) {
        const double U = i & 1 ? -0.2 : 0.3;
        struct wave_spec of = spec(WAVE_REGULAR, 0.03, 0.0, 0.16), still = of;
        of.period = 1.0;
        of.current = U;
        of.closed = still.closed = i < 2;
        struct waves *w = waves_create(&of);
        assert_close(w->period, 1.0, 1e-9);
        still.length = w->length;
        struct waves *s = waves_create(&still);
        assert_close(w->celerity, s->celerity + U, 1e-9);
        assert_close(w->transport, s->transport, 1e-12);
        for (int n = 0; n < 20; n++) {
            const double t = 0.3 * n, x = 0.17 * n, z = -0.007 * n;
            double u[3], v[3];
            waves_at(w, t);
            waves_at(s, t);
            assert_close(waves_eta(w, x, 0.0), waves_eta(s, x - U * t, 0.0), 1e-9);
            waves_velocity(w, x, 0.0, z, u);
            waves_velocity(s, x - U * t, 0.0, z, v);
            assert_close(u[0], v[0] + U, 1e-8);
            assert_close(u[1], v[1], 1e-8);
        }
        FREE(s, w);
    }
}

/* A group meets at its place and time over the ground, with its bound waves; each component runs
 * at its frequency at rest. */
TEST(groups_focus_on_currents)
{
    for (int i = 0; i < 4; i++) {
        struct wave_spec of = spec(WAVE_FOCUSED, 0.03, 0.0, 0.5);
        of.period = 1.2;
        of.order = 1 + i / 2;
        of.current = i & 1 ? -0.15 : 0.3;
        of.at[0] = 1.5;
        of.at[1] = 7.0;
        struct waves *w = waves_create(&of);
        double best = 0.0, at[2] = {0.0, 0.0};
        for (int n = SANITIZED ? -3 : -40; n <= (SANITIZED ? 3 : 40); n++)
            for (int m = 0; m <= 60; m++) {
                waves_at(w, 7.0 + 0.02 * n);
                if (waves_eta(w, 0.05 * m, 0.0) > best) {
                    best = waves_eta(w, 0.05 * m, 0.0);
                    at[0] = 0.05 * m;
                    at[1] = 7.0 + 0.02 * n;
                }
            }
        assert_close(at[0], 1.5, 0.051);
        assert_close(at[1], 7.0, 0.021);
        assert_close(best, w->crest, 0.01 * w->crest);
        for (int c = 0; c < w->ncomponents; c++) {
            const struct wave_component *q = w->components + c;
            const double rest = (q->w + q->k * of.current) * of.repeat / (2.0 * M_PI);
            assert_close(rest, round(rest), 1e-6);
        }
        FREE(w);
    }
}

TEST(currents_that_hold_waves_are_refused)
{
    char text[256];
    const char *key = "";
    struct wave_spec of = spec(WAVE_REGULAR, 0.01, 0.0, 0.5);
    of.period = 1.0;
    of.current = -0.5;
    assert_true(waves_refuse(&of, &key, text, sizeof text));
    assert_string_equal(key, "waves.current");
    of.period = 2.0;
    assert_false(waves_refuse(&of, &key, text, sizeof text));
    of.kind = WAVE_SEA; /* half as long again in frequency is held */
    of.current = -0.6;
    of.length = 2.0;
    of.period = 0.0;
    assert_true(waves_refuse(&of, &key, text, sizeof text));
    of.current = -0.2;
    assert_false(waves_refuse(&of, &key, text, sizeof text));
    of = spec(WAVE_REGULAR, 0.01, 0.3, 0.5);
    of.current = -0.5;
    assert_true(waves_refuse(&of, &key, text, sizeof text));
    assert_string_equal(key, "waves.current");
}

/* Depth and phase averages of a closed tank's wave: int u dz over a period is 0. */
TEST(closed_tanks_transport_nothing)
{
    struct wave_spec of = spec(WAVE_REGULAR, 0.05, 1.0, 0.3);
    struct waves *w = waves_create(&of);
    double flux = 0.0, size = 0.0;
    waves_at(w, 0.0);
    for (int i = 0; i < 256; i++) {
        const double x = i / 256.0, eta = waves_eta(w, x, 0.0);
        for (int j = 0; j < 200; j++) {
            double u[3];
            waves_velocity(w, x, 0.0, -0.3 + (j + 0.5) / 200.0 * (eta + 0.3), u);
            flux += u[0] * (eta + 0.3);
            size += fabs(u[0]) * (eta + 0.3);
        }
    }
    assert_true(fabs(flux) < 1e-5 * size);
    assert_true(w->current < 0.0);
    FREE(w);
}

TEST(periods_are_met)
{
    struct wave_spec of = spec(WAVE_REGULAR, 0.1, 0.0, 0.6);
    of.period = 1.3;
    struct waves *w = waves_create(&of);
    assert_close(w->period, 1.3, 1e-9);
    assert_close(w->length, w->celerity * 1.3, 1e-9);
    waves_at(w, 0.0);
    const double eta = waves_eta(w, 0.4, 0.0);
    waves_at(w, 1.3);
    assert_close(waves_eta(w, 0.4, 0.0), eta, 1e-9);
    FREE(w);
}

/* Too high, both or neither of length and period. */
TEST(waves_that_break_are_refused)
{
    const char *key;
    char text[256];
    struct wave_spec of = spec(WAVE_REGULAR, 0.4, 2.0, 0.6);
    assert_true(waves_refuse(&of, &key, text, sizeof text));
    assert_non_null(strstr(text, "the highest wave has 0.2"));
    of.height = 0.1;
    assert_false(waves_refuse(&of, &key, text, sizeof text));
    of.period = 1.0;
    assert_true(waves_refuse(&of, &key, text, sizeof text));
    assert_string_equal(key, "waves.period");
    /* Fenton's ends: 0.141063 lambda deep, 0.8332 d long */
    assert_close(waves_limit(100.0, 1.0), 0.141063, 1e-3);
    assert_close(waves_limit(1.0, 1e6), 0.8332, 1e-4);
}

/* Variance is Hs^2/16 over the time after which it repeats itself. */
TEST(seas_have_their_height)
{
    struct wave_spec of = spec(WAVE_SEA, 0.06, 2.0, 0.5);
    struct waves *w = waves_create(&of);
    double square = 0.0;
    enum { N = SANITIZED ? 600 : 6000, TIMES = SANITIZED ? 60 : N };
    for (int i = 0; i < TIMES; i++) {
        waves_at(w, of.repeat * i / TIMES);
        square += pow(waves_eta(w, 1.3, 0.0), 2.0) / TIMES;
    }
    if (!SANITIZED)
        assert_close(4.0 * sqrt(square), 0.06, 0.06 * 2e-3);
    /* the spectrum that gauges are held against has that variance, and its peak */
    double variance = 0.0;
    for (int i = 0; i < N; i++)
        variance += sea_spectrum(&of, 4.0 * (i + 0.5) / N / w->period) * 4.0 / N / w->period;
    assert_close(4.0 * sqrt(variance), 0.06, 0.06 * 2e-3);
    assert_close(sea_spectrum(&of, 1.0 / w->period),
                 0.5 * pow(w->components[(int)(0.5 * of.repeat / w->period + 0.5)].a, 2.0) *
                     of.repeat,
                 0.05 * sea_spectrum(&of, 1.0 / w->period));
    /* d eta/dt = w at z = 0 of linear theory, and div u = 0 below it */
    const double t = 7.3, x = 1.1, h = 1e-3;
    double a[3], b[3], c[3], d[3], u[3];
    waves_at(w, t + h);
    const double later = waves_eta(w, x, 0.0);
    waves_at(w, t - h);
    const double earlier = waves_eta(w, x, 0.0);
    waves_at(w, t);
    waves_velocity(w, x, 0.0, fmin(0.0, waves_eta(w, x, 0.0)), u);
    assert_close((later - earlier) / (2.0 * h), u[1], 0.05 * w->speed);
    waves_velocity(w, x + 0.01, 0.0, -0.2, a);
    waves_velocity(w, x - 0.01, 0.0, -0.2, b);
    waves_velocity(w, x, 0.0, -0.19, c);
    waves_velocity(w, x, 0.0, -0.21, d);
    assert_close(a[0] - b[0], -(c[1] - d[1]), 2e-5);
    FREE(w);
}

/* cos^2s(b/2) has the mean cosine s/(s+1); as many to the left as to the right. */
TEST(directions_have_their_spread)
{
    struct wave_spec of = spec(WAVE_SEA, 0.06, 2.0, 0.5);
    of.repeat = 3000.0;
    for (int i = 0; i < 2; i++) {
        of.spread = i ? 50.0 : 10.0;
        int n;
        struct wave_component *c = sea_components(&of, waves_period(&of), &n);
        double mean = 0.0, across = 0.0;
        for (int k = 0; k < n; k++) {
            assert_close(hypot(c[k].way[0], c[k].way[1]), 1.0, 1e-12);
            mean += c[k].way[0] / n;
            across += c[k].way[1] / n;
        }
        const double wide = sqrt(2.0 / (of.spread + 1.0)); /* of b, about */
        assert_close(mean, of.spread / (of.spread + 1.0), 3.0 * wide * wide / sqrt(n));
        assert_close(across, 0.0, 4.0 * wide / sqrt(n));
        mem_free(c);
    }
}

/* Level and velocities of a short-crested sea against its sum; div u = 0. */
TEST(short_crests_are_their_sum)
{
    struct wave_spec of = spec(WAVE_SEA, 0.06, 2.0, 0.5);
    of.spread = 10.0;
    of.window[1][1] = 2.0;
    struct waves *w = waves_create(&of);
    const double e = 0.02;
    assert_int_equal(w->table.parts, 3);
    for (int i = 0; i < (SANITIZED ? 4 : 40); i++) {
        const double x = fmod(0.37 * i, 3.0), y = fmod(0.73 * i, 2.0), t = 0.41 * i;
        double eta = 0.0, v = 0.0, u[3], div = 0.0;
        waves_at(w, t);
        for (int k = 0; k < w->ncomponents; k++) {
            const struct wave_component *c = w->components + k;
            const double th = c->k * (x * c->way[0] + y * c->way[1]) - c->w * t + c->phase;
            eta += c->a * cos(th);
            v += c->a * c->w * c->way[1] * cos(th) * cosh(c->k * 0.4) / sinh(c->k * 0.5);
        }
        assert_close(waves_eta(w, x, y), eta, 0.02 * 0.06);
        waves_velocity(w, x, y, -0.1, u);
        assert_close(u[2], v, 0.02 * w->speed);
        for (int q = 0; q < 2; q++) {
            const double way = q ? 1.0 : -1.0;
            double a[3], b[3], c[3];
            waves_velocity(w, x + way * e, y, -0.2, a);
            waves_velocity(w, x, y + way * e, -0.2, b);
            waves_velocity(w, x, y, -0.2 + way * e, c);
            div += way * (a[0] + b[2] + c[1]) / (2.0 * e);
        }
        assert_close(div, 0.0, 0.02 * w->speed * 2.0 * M_PI / w->length);
    }
    FREE(w);
}

TEST(groups_focus)
{
    struct wave_spec of = spec(WAVE_FOCUSED, 0.12, 2.0, 1.0);
    of.at[0] = 1.5;
    of.at[1] = 12.0;
    struct waves *w = waves_create(&of);
    double most = 0.0;
    for (int i = SANITIZED ? 1150 : 0; i <= (SANITIZED ? 1250 : 2000); i++) {
        waves_at(w, 0.01 * i);
        most = fmax(most, waves_eta(w, 1.5, 0.0));
    }
    waves_at(w, 12.0);
    assert_close(waves_eta(w, 1.5, 0.0), 0.06, 1e-4);
    assert_close(most, 0.06, 1e-4);
    FREE(w);
}

TEST(bits_do_not_depend_on_who_asks)
{
    struct wave_spec of = spec(WAVE_SEA, 0.06, 2.0, 0.5);
    struct waves *one = waves_create(&of), *other = waves_create(&of);
    double u[3], v[3];
    for (int i = 0; i < 50; i++)
        waves_at(one, 0.05 * i);
    waves_at(one, 1.2345);
    waves_at(other, 9.0);
    waves_at(other, 1.2345);
    waves_velocity(one, 0.7, 0.0, -0.1, u);
    waves_velocity(other, 0.7, 0.0, -0.1, v);
    assert_memory_equal(u, v, 2 * sizeof *u);
    FREE(one, other);
}

/* Without a zone all comes back, and long ones send on what u_w says. Of one length R is that of
 * the exact solution within a factor (0.008 to 0.02 at the best rate); half as long ten
 * times as much. */
TEST(zones_answer_as_they_should)
{
    const double k = 2.0 * M_PI, h = 1.0 / k, w = sqrt(9.81 * k * tanh(1.0));
    const struct zone_response bare = zone_response(w, k, 1.0, 9.81, h, 0.5, 1e-9),
                               half = zone_response(w, k, 1.0, 9.81, h, 0.5, 2.0 * w),
                               one = zone_response(w, k, 1.0, 9.81, h, 1.0, 2.0 * w),
                               three = zone_response(w, k, 1.0, 9.81, h, 3.0, 2.0 * w);
    assert_close(bare.reflected, 1.0, 1e-3);
    assert_true(one.reflected < 0.02 && one.reflected > 0.004);
    assert_true(half.reflected > 3.0 * one.reflected);
    assert_close(creal(three.make), 1.0, 0.01);
    assert_close(cimag(three.make), 0.0, 0.03);
    assert_close(creal(one.make), 1.12, 0.02);
}

/* What the zone before a side must move the water by to make a wave, or so that none comes back, is
 * not much more than the wave itself, however many of its lengths the zone has (13 of three times
 * the peak's frequency; of twice that it was 110 times as much). */
TEST(zones_ask_for_no_more_than_the_waves)
{
    const double depth = 0.5, period = 1.2,
                 length =
                     waves_length(&(struct wave_spec){.period = period, .g = 9.81, .depth = depth}),
                 peak = 2.0 * M_PI / period;
    const struct wave_spec of = {
        .g = 9.81, .depth = depth, .zone = 1.5 * length, .rate = 2.0 * peak, .normal = {1.0, 0.0}};
    struct sea_gains *is = sea_gains_create(&of, 0.5 * peak, 3.0 * peak);
    for (int k = 0; k <= 50; k++)
        for (int way = -1; way < 2; way += 2) {
            assert_true(cabs(sea_gains_at(is, (0.5 + 0.05 * k) * peak, way)) < 1.15);
        }
    FREE(is);
}

/* Biesel's transfer functions of pistons and of flaps hinged on the floor, kh 0.3, 1, 3; of flaps
 * close to the surface of deep water. */
TEST(paddles_have_biesels_ratios)
{
    static const double kh[] = {0.3, 1.0, 3.0}, piston[] = {0.2999, 0.9818, 1.9326},
                        flap[] = {0.1511, 0.5281, 1.3495};
    for (int i = 0; i < 3; i++) {
        assert_close(wave_maker_ratio(2.0 * kh[i], 0.5, -1.0), piston[i], 1e-4);
        assert_close(wave_maker_ratio(2.0 * kh[i], 0.5, 0.0), flap[i], 1e-4);
    }
    /* over deep water 2 (1 - (1 - e^-q)/q), q = k times the depth of the flap's axis */
    for (int i = 0; i < 3; i++) {
        const double k = 10.0 * pow(10.0, i), q = 0.04 * k;
        assert_close(wave_maker_ratio(k, 5.0, 4.96), 2.0 * (1.0 + expm1(-q) / q), 1e-9);
    }
}
