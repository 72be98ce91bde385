/* body_impedance.h - how strongly the fluid brakes a free body: the sum of rho c over its surface,
 * as a matrix, and from it a bound of the time step.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_IMPEDANCE_H
#define SPH_BODY_IMPEDANCE_H

#include "body.h"

/* Force and moment per velocity and angular velocity; zeroed memory is empty. */
struct impedance {
    double Z[6][6]; /* kg/s, kg m/s, kg m^2/s */
};

/* Adds a piece of surface with its arm from the centre, m, and its impedances along its normal n
 * and across it, kg/s. */
void impedance_add(struct impedance *z, const double *arm, const double *n, double along,
                   double across);
/* Largest eigenvalue of M^-1 Z in the degrees of freedom that are not locked, 1/s. */
double impedance_rate(const struct impedance *z, const struct body *b);
/* The same of fluid of impedance rho_c, kg/(m^2 s), and viscosity mu, Pa s, that wets all of its
 * surface at the start; particles of spacing dx, m. */
double impedance_stopping_rate(const struct body *b, double rho_c, double mu, double dx);

#endif
