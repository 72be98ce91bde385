/* coupling_steps.c - see coupling_steps.h. With n equal steps over the span, output q of the case,
 * at q every - since, comes after (q every - since) n/span steps. The search asks for the smallest
 * n at which that is a whole number (to `same' of a step) for all q. Nothing but the case enters,
 * so that all programs and the coupler find the same steps without a message.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "coupling_steps.h"

#include <math.h>

static const double rounding = 1e-9; /* relative */
static const double same = 1e-3;     /* of a step: an output this near to its end is there */
static const double steps_most = 1e15;

static bool has_outputs(double span, double since, double every)
{
    return every > 0.0 && every - since < span;
}

static double outputs(double span, double since, double every)
{
    return floor((span + since) / every * (1.0 + rounding));
}

/* Steps from the start of the span to its q-th output. */
static double place(double n, double q, double span, double since, double every)
{
    return q * (n * every / span) - n * since / span;
}

/* Steps: how far the last output before the end lies from the end of a step. It is the worst one
 * where the first lies on one and the outputs are nearly a whole number of steps apart. INFINITY if
 * two outputs would share a step, or the first one has none. */
static double last_off(double n, double span, double since, double every)
{
    const double apart = n * every / span, first = place(n, 1.0, span, since, every);
    if (rint(apart) < 1.0 || rint(first) < 1.0)
        return INFINITY;
    return fabs(first - rint(first)) +
           fabs(apart - rint(apart)) * (outputs(span, since, every) - 1.0);
}

/* From the fewest steps on, `least', up to as many more as there are outputs: where the outputs
 * divide the span evenly, making the steps between two of them a whole number adds less than one
 * step to each, so the search finds it. Computed in doubles, for span/dt may be beyond what an
 * integer holds. */
int64_t coupling_steps_number(double span, double since, double every, double dt)
{
    const bool any = has_outputs(span, since, every);
    const double alone = fmax(ceil(span / dt * (1.0 - rounding)), 1.0);
    const double least = any ? fmax(alone, ceil(span / every * (1.0 - rounding))) : alone;
    if (least > steps_most)
        return 0;
    if (any)
        for (double n = least; n <= alone + outputs(span, since, every); n += 1.0)
            if (last_off(n, span, since, every) < same)
                return (int64_t)n;
    return (int64_t)least;
}

/* The output nearest to the end of the step is the only one that can be there. */
bool coupling_steps_output(int64_t n, int64_t k, double span, double since, double every)
{
    if (k == n || !has_outputs(span, since, every))
        return k == n;
    const double q = rint(((double)k * span / (double)n + since) / every);
    return q >= 1.0 && k == (int64_t)rint(place((double)n, q, span, since, every));
}

/* Only where the outputs do not fit. After 1e4 outputs the worst distance is known well enough for
 * the line that tells it. */
double coupling_steps_off(int64_t n, double span, double since, double every)
{
    double most = 0.0;
    if (!has_outputs(span, since, every) || last_off((double)n, span, since, every) < same)
        return 0.0;
    for (double q = 1.0; q <= fmin(outputs(span, since, every), 1e4); q += 1.0) {
        const double at = place((double)n, q, span, since, every);
        most = fmax(most, fabs(at - rint(at)) * span / (double)n);
    }
    return most;
}
