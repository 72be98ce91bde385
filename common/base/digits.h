/* digits.h - limits in messages: what a reader takes over from one must hold, so that it is rounded
 * to the side where it does. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_DIGITS_H
#define COMMON_DIGITS_H

#include <math.h>

/* The largest number of so many digits that is not above x > 0, and the least not below it, but for
 * rounding. */
static inline double digits_below(double x, int digits)
{
    const double unit = pow(10.0, floor(log10(x)) - digits + 1.0);
    return floor(x / unit * (1.0 + 1e-12)) * unit;
}

static inline double digits_above(double x, int digits)
{
    const double unit = pow(10.0, floor(log10(x)) - digits + 1.0);
    return ceil(x / unit * (1.0 - 1e-12)) * unit;
}

#endif
