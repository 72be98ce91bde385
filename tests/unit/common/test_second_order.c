/* test_second_order.c - bound waves: a wave with itself is Stokes's second harmonic; deep water's
 * limits; with them the conditions on the surface are left as a^3; interpolated pairs are pairs; a
 * sea's tables meet the surface and transport nothing. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/waves/sea.h"
#include "../../../common/waves/second_order.h"

static const double g = 9.81;

TEST(a_wave_with_itself_is_stokes)
{
    static const double depths[] = {0.3, 1.0, 50.0};
    for (int d = 0; d < 3; d++) {
        const double w = 2.0 * M_PI / 1.3, h = depths[d], k[2] = {waves_number(w, g, h), 0.0},
                     t = tanh(k[0] * h), stokes = 0.25 * k[0] * (3.0 - t * t) / (t * t * t);
        assert_close(0.5 * bound_wave_of(k, k, w, w, 1, g, h).eta, stokes, 1e-9 * stokes);
        assert_close(bound_wave_stokes(0.01, k[0], h), 0.01 * stokes, 1e-9 * stokes);
    }
}

/* (k2 + k1)/2 and -(k2 - k1)/2, as far as a depth of 1000 m is deep for the difference. */
TEST(deep_water_has_its_limits)
{
    const double w1 = 5.0, w2 = 6.0, k1[2] = {w1 * w1 / g, 0.0}, k2[2] = {w2 * w2 / g, 0.0};
    assert_close(bound_wave_of(k1, k2, w1, w2, 1, g, 1e3).eta, 0.5 * (k1[0] + k2[0]), 1e-9);
    assert_close(bound_wave_of(k1, k2, w1, w2, -1, g, 1e3).eta, -0.5 * (k2[0] - k1[0]), 1e-9);
}

/* --- the conditions on the surface --- */

struct place {
    double x, y, t;
};
struct fields {
    double eta, ex, ey, et, u, v, w, phi_t;
};

/* A wave of level Y cos and phi F cosh K(z+h)/cosh Kh sin, at the height z. */
static void add_wave(struct fields *f, double z, double h, double Y, double F, const double k[2],
                     double W, double th)
{
    const double K = hypot(k[0], k[1]), c = cos(th), s = sin(th),
                 ch = cosh(K * (z + h)) / cosh(K * h), sh = sinh(K * (z + h)) / cosh(K * h);
    f->eta += Y * c;
    f->ex -= Y * k[0] * s;
    f->ey -= Y * k[1] * s;
    f->et += Y * W * s;
    f->u += F * k[0] * ch * c;
    f->v += F * k[1] * ch * c;
    f->w += F * K * sh * s;
    f->phi_t -= F * W * ch * c;
}

enum { THREE = 3 };
static const double omega[THREE] = {4.0, 5.1, 6.7}, way[THREE] = {0.0, 0.7, -1.1};

static void number_of(int i, double h, double k[2])
{
    const double all = waves_number(omega[i], g, h);
    k[0] = all * cos(way[i]);
    k[1] = all * sin(way[i]);
}

static double phase_of(int i, const double k[2], const struct place *at)
{
    return k[0] * at->x + k[1] * at->y - omega[i] * at->t;
}

static struct fields fields_of(const struct place *at, double a, double z, double h, bool second)
{
    struct fields f = {.eta = 0.0};
    for (int i = 0; i < THREE; i++) {
        double k1[2], k2[2];
        number_of(i, h, k1);
        const double th1 = phase_of(i, k1, at);
        add_wave(&f, z, h, a, g * a / omega[i], k1, omega[i], th1);
        for (int j = i; j < THREE && second; j++)
            for (int s = -1; s <= 1; s += 2) {
                if (i == j && s < 0)
                    continue;
                number_of(j, h, k2);
                const struct bound_wave b = bound_wave_of(k1, k2, omega[i], omega[j], s, g, h);
                const double k[2] = {k1[0] + s * k2[0], k1[1] + s * k2[1]},
                             c = a * a * (i == j ? 0.5 : 1.0);
                add_wave(&f, z, h, c * b.eta, c * b.u / b.K, k, b.W, th1 + s * phase_of(j, k2, at));
            }
    }
    return f;
}

/* Largest rest of both conditions; means belong to Bernoulli's constant. */
static double residual(double a, bool second)
{
    enum { PLACES = 400 };
    double kin[PLACES], dyn[PLACES], mean[2] = {0.0, 0.0}, most = 0.0;
    for (int i = 0; i < PLACES; i++) {
        const struct place at = {fmod(7.31 * i, 20.0), fmod(3.77 * i, 20.0), fmod(1.93 * i, 20.0)};
        const double eta = fields_of(&at, a, 0.0, 0.6, second).eta;
        const struct fields f = fields_of(&at, a, eta, 0.6, second);
        kin[i] = f.et + f.u * f.ex + f.v * f.ey - f.w;
        dyn[i] = f.phi_t + 0.5 * (f.u * f.u + f.v * f.v + f.w * f.w) + g * f.eta;
        mean[0] += kin[i] / PLACES;
        mean[1] += dyn[i] / PLACES;
    }
    for (int i = 0; i < PLACES; i++)
        most = fmax(most, fmax(fabs(kin[i] - mean[0]), fabs(dyn[i] - mean[1])));
    return most;
}

TEST(the_surface_is_met_to_third_order)
{
    const double first = log2(residual(0.002, false) / residual(0.001, false)),
                 second = log2(residual(0.002, true) / residual(0.001, true));
    assert_close(first, 2.0, 0.05);
    assert_close(second, 3.0, 0.1);
}

/* --- sums --- */

enum { COMPONENTS = 40 };

/* 40 waves of a group, as f from 0.3 to 1.2 Hz with a peak of 2 s over 1 m: 3.7 % by the double
 * sum. */
TEST(second_order_adds_to_a_focused_crest)
{
    double a[COMPONENTS], w[COMPONENTS], k[COMPONENTS][2], sum = 0.0, second = 0.0;
    for (int i = 0; i < COMPONENTS; i++) {
        const double f = 0.3 + 0.9 * i / (COMPONENTS - 1);
        a[i] = sea_jonswap(2.0 * f, 3.3);
        sum += a[i];
        w[i] = 2.0 * M_PI * f;
        k[i][0] = waves_number(w[i], g, 1.0);
        k[i][1] = 0.0;
    }
    for (int i = 0; i < COMPONENTS; i++)
        for (int j = i; j < COMPONENTS; j++) {
            const double c = pow(0.06 / sum, 2.0) * a[i] * a[j];
            second +=
                c * (i == j ? 0.5 : 1.0) * bound_wave_of(k[i], k[j], w[i], w[j], 1, g, 1.0).eta;
            if (i != j)
                second += c * bound_wave_of(k[i], k[j], w[i], w[j], -1, g, 1.0).eta;
        }
    assert_close(second / 0.06, 0.037, 0.0005);
}

static struct wave_spec sea_of(double height, double length, double depth)
{
    struct wave_spec of = {.kind = WAVE_SEA,
                           .height = height,
                           .length = length,
                           .depth = depth,
                           .g = g,
                           .rho = 1000.0,
                           .closed = true,
                           .peak = 3.3,
                           .seed = 4,
                           .order = 2,
                           .window = {{0.0, 3.0}, {0.0, 0.0}}};
    of.repeat = 30.0 * waves_period(&of);
    return of;
}

enum { ROW = 11 }; /* columns, of which the last one is looked at */

/* More components than frequencies, shallow and deep, level and velocities on it, against the
 * double sum. */
TEST(interpolated_pairs_are_pairs)
{
    for (int deep = 0; deep < 2; deep++) {
        const double h = deep ? 4.0 : 0.4;
        const struct wave_spec of = sea_of(0.06, 2.0, h);
        double nodes[WAVE_NODES], off[3] = {0.0}, most[3] = {0.0};
        int n;
        struct wave_component *c = sea_components(&of, waves_period(&of), &n);
        for (int j = 0; j < WAVE_NODES; j++)
            nodes[j] = -h * pow(j / (WAVE_NODES - 1.0), 2.0);
        struct second_order *s = second_order_create(n, c, g, h, nodes, false);
        assert_true(second_order_frequencies(s) < n);
        for (int at = 0; at < 30; at++) {
            const double x = 0.37 * at, t = 1.7 * at;
            double is[3] = {0.0}, level[ROW] = {0.0}, row[ROW][WAVE_NODES * 2] = {{0.0}};
            second_order_add(s, t, x - (ROW - 1) * 0.02, 0.02, ROW, level, row[0]);
            const double told = level[ROW - 1], *u = row[ROW - 1];
            for (int i = 0; i < n; i++)
                for (int j = i; j < n; j++)
                    for (int q = -1; q <= 1; q += 2) {
                        if (i == j && q < 0)
                            continue;
                        const double k1[2] = {c[i].k, 0.0}, k2[2] = {c[j].k, 0.0},
                                     th1 = c[i].k * x - c[i].w * t + c[i].phase,
                                     th = th1 + q * (c[j].k * x - c[j].w * t + c[j].phase);
                        const struct bound_wave b = bound_wave_of(k1, k2, c[i].w, c[j].w, q, g, h);
                        const double A = c[i].a * c[j].a * (i == j ? 0.5 : 1.0);
                        is[0] += A * b.eta * cos(th);
                        is[1] += A * b.u * (q < 0 ? -1.0 : 1.0) * cos(th);
                        is[2] += A * b.w * sin(th);
                    }
            off[0] = fmax(off[0], fabs(is[0] - told));
            most[0] = fmax(most[0], fabs(told));
            for (int a = 0; a < 2; a++) {
                off[1 + a] = fmax(off[1 + a], fabs(is[1 + a] - u[a]));
                most[1 + a] = fmax(most[1 + a], fabs(u[a]));
            }
        }
        for (int a = 0; a < 3; a++)
            assert_close(off[a] / most[a], 0.0, 0.01);
        FREE(s, c);
    }
}

/* Largest |eta_t + u eta_x - w| on the surface of a sea's tables over the height. */
static double leaves_its_surface(double height, int order)
{
    struct wave_spec of = sea_of(height, 2.0, 0.5);
    of.order = order;
    struct waves *w = waves_create(&of);
    const double e = 1e-3;
    double most = 0.0;
    for (int i = 0; i < (SANITIZED ? 10 : 100); i++) {
        const double x = 0.3 + fmod(0.137 * i, 2.4), t = 1.24 * i;
        double u[3];
        waves_at(w, t + e);
        const double later = waves_eta(w, x, 0.0);
        waves_at(w, t - e);
        const double earlier = waves_eta(w, x, 0.0);
        waves_at(w, t);
        const double eta = waves_eta(w, x, 0.0);
        waves_velocity(w, x, 0.0, eta, u);
        u[0] -= w->current; /* of third order here */
        most = fmax(most,
                    fabs((later - earlier) / (2.0 * e) - u[1] +
                         u[0] * (waves_eta(w, x + e, 0.0) - waves_eta(w, x - e, 0.0)) / (2.0 * e)));
    }
    FREE(w);
    return most;
}

TEST(tables_meet_the_surface)
{
    const double first = leaves_its_surface(0.04, 1), second = leaves_its_surface(0.04, 2),
                 half = leaves_its_surface(0.02, 2);
    print_message("rest over height: %.3g, of second order %.3g, at half the height %.3g\n", first,
                  second, half);
    assert_true(second < first);
    assert_close(log2(second / half), 3.0, 0.25);
}

TEST(seas_transport_nothing)
{
    const struct wave_spec of = sea_of(0.06, 2.0, 0.5);
    struct waves *w = waves_create(&of);
    enum { TIMES = SANITIZED ? 10 : 400, PARTS = 60 };
    double flux = 0.0;
    for (int i = 0; i < TIMES; i++) {
        waves_at(w, of.repeat * i / TIMES);
        const double eta = waves_eta(w, 1.3, 0.0);
        for (int j = 0; j < PARTS; j++) {
            double u[3];
            waves_velocity(w, 1.3, 0.0, -0.5 + (j + 0.5) / PARTS * (eta + 0.5), u);
            flux += u[0] * (eta + 0.5) / PARTS / TIMES;
        }
    }
    assert_true(w->current < 0.0);
    if (!SANITIZED)
        assert_close(flux, 0.0, 0.05 * fabs(w->current) * 0.5);
    FREE(w);
}

/* A group of second order stands higher than its linear crest; far from it water is at rest. */
TEST(groups_stand_in_still_water)
{
    struct wave_spec of = sea_of(0.12, 0.0, 1.0);
    of.kind = WAVE_FOCUSED;
    of.length = 0.0;
    of.period = 2.0;
    of.repeat = 100.0;
    of.at[0] = 1.5;
    of.at[1] = 40.0;
    struct waves *w = waves_create(&of);
    waves_at(w, 40.0);
    const double eta = waves_eta(w, 1.5, 0.0);
    assert_close(eta, w->crest, 1e-3 * eta);
    assert_true(eta > 0.06 * 1.025 && eta < 0.06 * 1.05);
    double u[3];
    waves_at(w, 10.0);
    assert_close(waves_eta(w, 1.5, 0.0), 0.0, 0.02 * 0.06);
    waves_velocity(w, 1.5, 0.0, -0.5, u);
    assert_close(u[0], 0.0, 0.02 * w->speed);
    FREE(w);
}
