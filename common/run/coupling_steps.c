/* coupling_steps.c - see coupling_steps.h. With n equal steps over the span, output q of the case,
 * at q every, comes after q n every/span steps. The search asks for the smallest n at which that is
 * a whole number (to `same' of a step) for all q. Nothing but the case enters, so that all programs
 * and the coupler find the same steps without a message.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "coupling_steps.h"

#include <math.h>

static const double rounding = 1e-9; /* relative */
static const double same = 1e-3;     /* of a step: an output this near to its end is there */
static const double steps_most = 1e15;

static bool has_outputs(double span, double every) { return every > 0.0 && every < span; }

static double outputs(double span, double every) { return floor(span / every * (1.0 + rounding)); }

/* Steps: how far the last output before the end lies from the end of a step. It is the worst one
 * where the outputs are nearly a whole number of steps apart. INFINITY if two outputs would share a
 * step. */
static double last_off(double n, double span, double every)
{
    const double apart = n * every / span;
    return rint(apart) < 1.0 ? INFINITY : fabs(apart - rint(apart)) * outputs(span, every);
}

/* From the fewest steps on, `least', up to as many more as there are outputs: where the outputs
 * divide the span evenly, making the steps between two of them a whole number adds less than one
 * step to each, so the search finds it. Computed in doubles, for span/dt may be beyond what an
 * integer holds. */
int64_t coupling_steps_number(double span, double every, double dt)
{
    const bool any = has_outputs(span, every);
    const double alone = fmax(ceil(span / dt * (1.0 - rounding)), 1.0);
    const double least = any ? fmax(alone, ceil(span / every * (1.0 - rounding))) : alone;
    if (least > steps_most)
        return 0;
    if (any)
        for (double n = least; n <= alone + outputs(span, every); n += 1.0)
            if (last_off(n, span, every) < same)
                return (int64_t)n;
    return (int64_t)least;
}

bool coupling_steps_output(int64_t n, int64_t k, double span, double every)
{
    if (k == n || !has_outputs(span, every))
        return k == n;
    const double apart = (double)n * every / span, q = rint((double)k / apart);
    return q >= 1.0 && k == (int64_t)rint(q * apart);
}

/* Only where the outputs do not fit. After 1e4 outputs the worst distance is known well enough for
 * the line that tells it. */
double coupling_steps_off(int64_t n, double span, double every)
{
    double most = 0.0;
    if (!has_outputs(span, every) || last_off((double)n, span, every) < same)
        return 0.0;
    for (double q = 1.0; q <= fmin(outputs(span, every), 1e4); q += 1.0) {
        const double at = q * every * (double)n / span;
        most = fmax(most, fabs(at - rint(at)) * span / (double)n);
    }
    return most;
}
