/* body_impedance.h - see body_impedance.c. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_IMPEDANCE_H
#define SPH_BODY_IMPEDANCE_H

#include "body.h"

struct impedance {
    double Z[6][6]; /* kg/s, kg m/s, kg m^2/s */
};

/* A piece of surface with its arm from the centre: impedances along its normal n and across, kg/s.
 */
void impedance_add(struct impedance *z, const double *arm, const double *n, double along,
                   double across);
/* Largest eigenvalue of M^-1 Z in the degrees that are free, 1/s. */
double impedance_rate(const struct impedance *z, const struct body *b);

#endif
