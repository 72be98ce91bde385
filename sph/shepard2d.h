/* shepard2d.h - what a wall takes from the Shepard factor of Wendland's C2 kernel in 2D, analytic
 * [4.52-4.59]: gamma(x) = int over the fluid of W = 1 + sum over segments of shepard_segment; 1
 * inside, 1/2 on a flat wall, angle/(2 pi) in a corner. Lengths in units of R. Behind a wall it
 * returns gamma + 1 > 1. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SHEPARD2D_H
#define SPH_SHEPARD2D_H

#include <math.h>

/* [4.56-4.58] for d > 0, odd in x; the exponents of the first bracket are illegible in print and
 * were rebuilt from the integral. */
static inline double shepard_antiderivative(double x, double d)
{
    const double d2 = d * d, x2 = x * x, r2 = x2 + d2, r = sqrt(r2);
    const double radial = r * (8.0 * r2 * r2 + (10.0 * d2 + 84.0) * r2 + d2 * (15.0 * d2 + 126.0));
    const double plain = 42.0 * x2 * x2 + (140.0 * d2 + 70.0) * x2 + 210.0 * d2 * (d2 + 1.0) - 42.0;
    return d * d2 * d2 * (15.0 * d2 + 126.0) * asinh(x / d) - 6.0 * atan(x / d) +
           d * x * (radial - plain);
}

/* Segment of which x sees a piece: `distance' of x from its line (> 0 on the fluid side), `from'
 * and `to' along it from the foot of x [4.55]. */
static inline double shepard_segment(double distance, double from, double to)
{
    const double d = fmax(fabs(distance), 1e-14);
    if (d >= 1.0)
        return 0.0;
    const double half = sqrt(1.0 - d * d), lo = fmax(from, -half), hi = fmin(to, half);
    if (hi <= lo)
        return 0.0;
    const double c =
        (shepard_antiderivative(hi, d) - shepard_antiderivative(lo, d)) / (12.0 * M_PI);
    return distance >= -1e-9 ? c : -c;
}

#endif
