/* sea.c - the components: see sea.h. SPDX-License-Identifier: BSD-3-Clause */
#include "sea.h"

#include <math.h>
#include <stdint.h>

#include "../base/mem.h"

static const double lowest = 0.5, highest = 3.0; /* of the peak's frequency */

/* splitmix64: the same sea on every machine. */
static double uniform(uint64_t *state)
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

struct wave_component *sea_components(const struct wave_spec *of, double period, int *n)
{
    const double df = 1.0 / of->repeat, peak = 1.0 / period;
    const int first = (int)ceil(lowest * peak / df), last = (int)floor(highest * peak / df);
    struct wave_component *c = NEW(struct wave_component, last - first + 1);
    uint64_t state = (uint64_t)of->seed;
    double sum = 0.0, squares = 0.0;
    *n = last - first + 1;
    for (int i = 0; i < *n; i++) {
        const double f = (first + i) * df, S = sea_jonswap(f / peak, of->peak);
        const double w = 2.0 * M_PI * f, k = waves_number(w, of->g, of->depth);
        const double phase = 2.0 * M_PI * uniform(&state);
        const bool random = of->kind == WAVE_SEA;
        c[i] = (struct wave_component){.a = random ? sqrt(2.0 * S) : S,
                                       .w = w,
                                       .k = k,
                                       .phase = random ? phase : w * of->at[1] - k * of->at[0]};
        sum += c[i].a;
        squares += 0.5 * c[i].a * c[i].a;
    }
    const double scale =
        of->kind == WAVE_SEA ? 0.25 * of->height / sqrt(squares) : 0.5 * of->height / sum;
    for (int i = 0; i < *n; i++)
        c[i].a *= scale;
    return c;
}
