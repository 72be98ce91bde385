/* digits.h - rounds limits that a message prints. A reader copies such a limit into the case, where
 * it must be accepted: an upper limit is rounded down, a lower limit up.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <math.h>

/* The largest number of `digits' significant decimal digits that is not above x. x must be > 0. A
 * relative 1e-12 is granted, so that 0.1 itself stays 0.1 in spite of its rounding error. */
static inline double digits_below(double x, int digits)
{
    const double unit = pow(10.0, floor(log10(x)) - digits + 1.0);
    return floor(x / unit * (1.0 + 1e-12)) * unit;
}

/* The smallest number of `digits' significant decimal digits that is not below x > 0, with the same
 * allowance for rounding. */
static inline double digits_above(double x, int digits)
{
    const double unit = pow(10.0, floor(log10(x)) - digits + 1.0);
    return ceil(x / unit * (1.0 - 1e-12)) * unit;
}
