/* sea.c - the components of a sea or a group: see sea.h. Frequencies are multiples of 1/repeat from
 * half to three times that of the peak, outside of which JONSWAP's spectrum has next to no energy;
 * so the sea repeats itself after `repeat' seconds and not before. Every rank draws the same random
 * numbers.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sea.h"

#include "../base/base.h"

static const double lowest = 0.5, highest = 3.0; /* of the peak's frequency */

double sea_uniform(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

double sea_jonswap(double f, double gamma)
{
    const double s = f <= 1.0 ? 0.07 : 0.09;
    return pow(f, -5.0) * exp(-1.25 * pow(f, -4.0)) *
           pow(gamma, exp(-(f - 1.0) * (f - 1.0) / (2.0 * s * s)));
}

enum { DIRECTIONS = 400 };
static const double widest = 75.0 * M_PI / 180.0; /* waves along a side leave no zone before it */

/* Directions of a sea, one of each component, by the share of D(b) ~ cos^2s(b/2) below them; the
 * phases are those of the same sea without them. By inversion of the summed distribution, linear
 * within its DIRECTIONS steps. */
static void draw_directions(const struct wave_spec *of, int n, struct wave_component *c)
{
    double share[DIRECTIONS + 1] = {0.0};
    uint64_t state = (uint64_t)of->seed ^ 0x5a17c0de5a17c0deu;
    const double gap = 2.0 * widest / DIRECTIONS;
    for (int i = 0; i < DIRECTIONS; i++)
        share[i + 1] = share[i] + pow(cos(0.5 * ((i + 0.5) * gap - widest)), 2.0 * of->spread);
    for (int k = 0; k < n; k++) {
        const double at = sea_uniform(&state) * share[DIRECTIONS];
        int i = 0;
        while (i + 1 < DIRECTIONS && share[i + 1] < at)
            i++;
        const double b = gap * (i + (at - share[i]) / (share[i + 1] - share[i])) - widest;
        c[k].way[0] = cos(b);
        c[k].way[1] = sin(b);
    }
}

/* Scaled so that its integral over the components' range is height^2/16, as sea_components scales
 * the amplitudes. */
double sea_spectrum(const struct wave_spec *of, double f)
{
    enum { PARTS = 2000 };
    const double T = waves_period(of);
    double sum = 0.0;
    for (int k = 0; k < PARTS; k++)
        sum += sea_jonswap(lowest + (k + 0.5) * (highest - lowest) / PARTS, of->peak);
    sum *= (highest - lowest) / PARTS / T;
    return f * T < lowest || f * T > highest
               ? 0.0
               : of->height * of->height / 16.0 * sea_jonswap(f * T, of->peak) / sum;
}

/* With a current U, frequencies over the ground are multiples of 1/repeat; w is that in the water's
 * frame, w = 2 pi f - k U. A random number is drawn for each component even of a group, so that the
 * sequence is the same for both kinds. */
struct wave_component *sea_components(const struct wave_spec *of, double period, int *n)
{
    const double df = 1.0 / of->repeat, peak = 1.0 / period;
    const int first = (int)ceil(lowest * peak / df);
    int last = (int)floor(highest * peak / df);
    while (last > first && /* what a current against the sea holds is not there */
           isnan(waves_number_on(2.0 * M_PI * last * df, of->current, of->g, of->depth)))
        last--;
    struct wave_component *c = NEW(struct wave_component, last - first + 1);
    uint64_t state = (uint64_t)of->seed;
    double sum = 0.0, squares = 0.0;
    *n = last - first + 1;
    const double focus = of->at[0] - of->current * of->at[1]; /* in the water's frame */
    for (int i = 0; i < *n; i++) {
        const double f = (first + i) * df, S = sea_jonswap(f / peak, of->peak);
        const double rest = 2.0 * M_PI * f,
                     k = waves_number_on(rest, of->current, of->g, of->depth),
                     w = rest - k * of->current;
        const double phase = 2.0 * M_PI * sea_uniform(&state);
        const bool random = of->kind == WAVE_SEA;
        c[i] = (struct wave_component){.a = random ? sqrt(2.0 * S) : S,
                                       .w = w,
                                       .k = k,
                                       .way = {1.0, 0.0},
                                       .phase = random ? phase : w * of->at[1] - k * focus};
        sum += c[i].a;
        squares += 0.5 * c[i].a * c[i].a;
    }
    const double scale =
        of->kind == WAVE_SEA ? 0.25 * of->height / sqrt(squares) : 0.5 * of->height / sum;
    for (int i = 0; i < *n; i++)
        c[i].a *= scale;
    if (of->spread > 0.0)
        draw_directions(of, *n, c);
    return c;
}
