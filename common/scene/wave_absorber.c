/* wave_absorber.c - see wave_absorber.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_absorber.h"

#include <complex.h>

#include "../waves/waves.h"
#include "scene_fluid.h"
#include "scene_waves.h"
#include "wave_maker.h"

/* Rates at which the paddle's place and the level's mean are forgotten, over the design's angular
 * frequency. Where the tank is closed a level that reads x too low moves the paddle by some x L/h,
 * and only both together let it go back: at 0.02 it took seventy seconds. */
static const double place_rate = 0.05, mean_rate = 0.1;

/* 1/m: of the n-th evanescent mode (n >= 1), w^2 = - g k tan kh, by bisection between its poles. */
static double evanescent_number(int n, double w, double g, double h)
{
    double lo = (n - 0.5) * M_PI, hi = n * M_PI;
    for (int i = 0; i < 60; i++) {
        const double kh = 0.5 * (lo + hi), rest = w * w * h / g + kh * tan(kh);
        lo = rest < 0.0 ? kh : lo;
        hi = rest < 0.0 ? hi : kh;
    }
    return 0.5 * (lo + hi) / h;
}

/* Level at a distance x from the face over the displacement that raises it, Biesel's transfer
 * function at imaginary wave numbers. */
static double evanescent_level(double w, double g, double h, double l, double x)
{
    enum { MODES = 200 };
    double sum = 0.0;
    for (int n = 1; n <= MODES; n++) {
        const double k = evanescent_number(n, w, g, h), kh = k * h;
        const double turn = l < 0.0 ? 0.0 : (cos(k * l) - cos(kh)) / (k * (h - l));
        sum += 4.0 * sin(kh) * (sin(kh) - turn) / (sin(2.0 * kh) + 2.0 * kh) * exp(-k * x);
    }
    return sum;
}

/* Gain and lag with which waves of the design do not come back. A wave e^(i(wt + kx)) alone needs
 * the displacement X = i/c, c what a displacement makes, so that the gauge reads e^(ikd) + b X, b
 * the level beside the paddle over its displacement:
 *   g F (e^(ikd) + i b/c) = (w/c)(1 - i r/w),   F = 1/(1 + i w T) . 1/(1 - i m/w),
 * r and m the rates at which place and mean are forgotten. */
static void tune(struct wave_absorber *a)
{
    const double complex read = cexp(I * a->k * a->distance) + I * a->beside / a->made;
    const double w = a->omega, turn = tan(carg(read) + atan(place_rate) + atan(mean_rate));
    a->rate = place_rate * w;
    a->mean_rate = mean_rate * w;
    a->lag = turn / w;
    a->gain = w / a->made / cabs(read) * hypot(1.0, turn) * hypot(1.0, place_rate) *
              hypot(1.0, mean_rate);
}

/* at is the gauge's place at rest, at the still level; along is where the waves go. */
struct wave_absorber *wave_absorber_create(const struct scene *s, const struct scene_body *b,
                                           const struct scene_motion *m, double distance)
{
    struct wave_absorber *a = NEW(struct wave_absorber, 1);
    const struct wave_spec of = scene_waves_spec(s);
    const int up = scene_still_axis(s);
    struct wave_paddle p;
    wave_paddle_of(s, b, m, &p);
    *a = (struct wave_absorber){.axis = m->axis,
                                .per = p.per,
                                .hinge = p.hinge,
                                .side = p.side,
                                .distance = distance,
                                .still = scene_waves_level(s),
                                .depth = of.depth,
                                .g = of.g,
                                .waves = mem_own(a, waves_create(&of))};
    scene_waves_direction(s, a->along, NULL);
    a->k = 2.0 * M_PI / a->waves->length;
    a->omega = 2.0 * M_PI / a->waves->period;
    a->made = wave_maker_ratio(a->k, of.depth, p.hinge);
    a->beside = evanescent_level(a->omega, of.g, of.depth, p.hinge, distance);
    for (int i = 0; i < 3; i++)
        a->at[i] = p.middle[i];
    vec3_add(a->at, p.face + p.side * distance - vec3_dot(a->at, a->along), a->along);
    a->at[up] = s->fluid.gravity[up] < 0.0 ? a->still : -a->still;
    tune(a);
    a->gain *= a->side;
    a->beside *= a->side;
    return a;
}

/* A paddle makes seas of first order. */
static double level_made(struct wave_absorber *a, double t, double x)
{
    const struct waves *w = a->waves;
    double eta = 0.0;
    if (w->of.kind == WAVE_REGULAR) {
        waves_at(a->waves, t);
        return waves_eta(w, x, 0.0);
    }
    for (int i = 0; i < w->ncomponents; i++) {
        const struct wave_component *c = w->components + i;
        eta += c->a * cos(c->k * x - c->w * t + c->phase);
    }
    return wave_maker_grown(w, t) * eta;
}

double wave_absorber_wanted(struct wave_absorber *a, double t, double X, double made)
{
    return level_made(a, t, vec3_dot(a->at, a->along) + X) + a->beside * made;
}

/* Share of the height of waves of another frequency that comes back, by the same linear loop. */
double wave_absorber_returns(const struct wave_absorber *a, double omega)
{
    const double k = waves_number(omega, a->g, a->depth), d = a->distance,
                 made = wave_maker_ratio(k, a->depth, a->hinge),
                 beside = evanescent_level(omega, a->g, a->depth, a->hinge, d);
    const double complex iw = I * omega,
                         F = a->side * a->gain / (1.0 + iw * a->lag) * iw / (iw + a->mean_rate),
                         X = -2.0 * F * cos(k * d) /
                             (iw + a->rate + F * (I * made * cexp(-I * k * d) + beside));
    return cabs(1.0 + I * made * X);
}
