/* wall_points.h - the integrals of wall_moments.h by a point an element, as the thesis has them:
 * segments in equal elements that do not move with the particle, midpoints that count within the
 * support. The numerical Shepard factor [4.51] errs where a point is nearer than an element: on a
 * flat wall by (1 - tanh(pi d/h))/2, d the distance and h the length of an element, if the foot is
 * between two points, by (1 - coth(pi d/h))/2 if it is on one. Lengths in units of R.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_POINTS_H
#define SPH_WALL_POINTS_H

#include <stdbool.h>

#include "wall_moments.h"

enum { WALL_POINTS = 15 }; /* along R, as in the thesis's validations */

/* As wall_moments; `numerical': gamma by the points, too, else in closed form [4.52-4.59]. */
static inline struct wall_moments wall_points(double distance, double from, double to,
                                              bool numerical)
{
    const double d2 = distance * distance, half2 = 1.0 - d2;
    struct wall_moments m = {0};
    if (half2 <= 0.0 || to <= from)
        return m;
    if (!numerical)
        m.gamma = wall_moments(distance, from, to).gamma;
    const int n = (int)ceil(WALL_POINTS * (to - from));
    const double h = (to - from) / n, half = sqrt(half2);
    const int first = (int)fmax(0.0, floor((-half - from) / h));
    for (int k = first; k < n; k++) {
        const double y = from + (k + 0.5) * h, r2 = d2 + y * y, r = sqrt(r2);
        if (y >= half)
            break;
        if (r >= 1.0 || r == 0.0)
            continue;
        const double t = (1.0 - r) * (1.0 - r), W = 7.0 / M_PI * t * t * (1.0 + 4.0 * r) * h;
        m.W += W;
        m.along += W * y;
        if (numerical) /* f(r) (y - x).n h, f = -int_r^1 W s ds / r^2 [4.44] */
            m.gamma -= wall_ring(r) / r2 * distance * h;
    }
    if (m.W > 0.0)
        m.along /= m.W;
    return m;
}

#endif
