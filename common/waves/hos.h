/* hos.h - vertical velocity W on the surface of waves as a sum of orders in steepness (West et al.,
 * J. Geophys. Res. 92, 1987), from the potential phi_s there:
 *   phi^(1) = phi_s, phi^(m) = -sum_{q=1}^{m-1} eta^q/q! d_z^q phi^(m-q),
 *   W^(m) = sum_{q=0}^{m-1} eta^q/q! d_z^(q+1) phi^(m-q), at z = 0,
 * d_z^q of a mode: k^q, for odd q times tanh kh. Some ten times cheaper than layer.h up to a
 * steepness k a of 0.3, above which the sum fails. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_HOS_H
#define COMMON_HOS_H

#include "wave_grid.h"

enum { HOS_ORDERS = 9 };

/* work arrays of the expansion: made by hos_create */
struct hos;

/* Of the order M <= HOS_ORDERS over water of depth m; modes with |k| > highest, 1/m, are left out.
 * The grid is borrowed. */
struct hos *hos_create(const struct wave_grid *grid, double depth, int order, double highest);
/* From eta, m, phi_s, m^2/s, and slope2 = |grad eta|^2, all [cells], consistently to order M: rise
 * = (1 + |grad eta|^2) W, m/s, and square = (1 + |grad eta|^2) W^2, m^2/s^2, [cells]. */
void hos_rise(struct hos *h, const double *eta, const double *phi, const double *slope2,
              double *rise, double *square);

#endif
