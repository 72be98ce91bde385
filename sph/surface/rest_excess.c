/* rest_excess.c - see rest_excess.h. Under a free surface the momentum equation sums over part of a
 * support, and water at rest needs more than its weight for the balance: 0.3, 0.19 and 0.06 rho g
 * dx in the first three rows with R/dx 4. These are the means of tanks at rest with riemann_ale, 8
 * and 16 rows of 0.02 and 0.01 m, after 6 s, linear between the rows and over R, with which they
 * scale. (refinement/guards.c has what two levels without mass flux have, over the pressure
 * itself.) SPDX-License-Identifier: BSD-3-Clause */
#include "rest_excess.h"

#include "../../common/base/base.h"

double rest_excess(double depth)
{
    static const double of[][2] = {{-0.25, 0.0},   {0.0, 0.1},     {0.147, 0.075},
                                   {0.342, 0.046}, {0.63, 0.0155}, {0.87, 0.0}};
    enum { ROWS = sizeof of / sizeof of[0] };
    return lookup_linear(of, ROWS, depth);
}
