/* zone_gain.h - what a zone before a closed side does to linear waves: there velocities follow
 * du/dt = -grad p/rho - r (u - u_w), r = rate chi^2, chi from 1 at the side to 0 at the zone's
 * inner edge. The side itself stands still and not as u_w wants it, which sends out waves of its
 * own; the zone damps them once on their way, so a share of some per cent is missing or comes back.
 * What u_w must be multiplied by to make up for it follows from the linear problem.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_ZONE_GAIN_H
#define COMMON_ZONE_GAIN_H

/* What the zone does to waves of one frequency. */
struct zone_response {
    double _Complex make; /* factor of u_w (of e^(iwt)) for waves that run away from the side */
    double _Complex pass; /* the same for waves that run to the side and shall not come back */
    double reflected;     /* -: share of the height that comes back with u_w = 0 */
};

/* omega (1/s), number (1/m) of the waves, cosine (> 0) of the angle between their direction and the
 * side's normal; below 0.1 the waves run along the side, which changes nothing. depth and length of
 * the zone, m; rate at the side, 1/s. */
struct zone_response zone_response(double omega, double number, double cosine, double g,
                                   double depth, double length, double rate);

#endif
