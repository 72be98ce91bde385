/* eos.h - Tait's equation of state [1.8-1.9] with gamma 7 or 1.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_EOS_H
#define SPH_EOS_H

#include <math.h>

static inline double eos_p(double rho, double rho0, double c0, double gamma)
{
    const double r = rho / rho0, r2 = r * r;
    return gamma == 1.0 ? c0 * c0 * (rho - rho0) : rho0 * c0 * c0 / 7.0 * (r2 * r2 * r2 * r - 1.0);
}

static inline double eos_c(double rho, double rho0, double c0, double gamma)
{
    const double r = rho / rho0;
    return gamma == 1.0 ? c0 : c0 * r * r * r;
}

/* Inverse of eos_p; p below -rho0 c0^2/gamma, where no density fits, counts as just above it. */
static inline double eos_rho(double p, double rho0, double c0, double gamma)
{
    const double s = 1.0 + gamma * p / (rho0 * c0 * c0);
    return gamma == 1.0 ? rho0 * s : rho0 * pow(s > 1e-3 ? s : 1e-3, 1.0 / 7.0);
}

/* Pressure at which the enthalpy, the integral of dp/rho, is that of a flow of constant density at
 * pressure p: gradients over density are then the same, and so is the level of water at rest. */
static inline double eos_p_from_constant(double p, double rho0, double c0, double gamma)
{
    const double s = p / (rho0 * c0 * c0), t = 1.0 + 6.0 * s;
    const double r = gamma == 1.0 ? exp(s) : pow(t > 1e-3 ? t : 1e-3, 1.0 / 6.0);
    return eos_p(rho0 * r, rho0, c0, gamma);
}

#endif
