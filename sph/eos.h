/* eos.h - Tait's equation of state p = rho0 c0^2/gamma [(rho/rho0)^gamma - 1] [1.8-1.9]; gamma 7 or 1
 * (then p = c0^2 (rho - rho0)). SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_EOS_H
#define SPH_EOS_H

#include <math.h>

/* Pa */
static inline double eos_p(double rho, double rho0, double c0, double gamma)
{
    const double x = rho / rho0, B = rho0 * c0 * c0 / gamma;
    const double x3 = x * x * x;
    return B * ((gamma == 1.0 ? x : x3 * x3 * x) - 1.0);
}

/* m/s */
static inline double eos_c(double rho, double rho0, double c0, double gamma)
{
    const double x = rho / rho0;
    return gamma == 1.0 ? c0 : c0 * (x * x * x);
}

/* kg/m^3; NaN below the least pressure that the law knows, -rho0 c0^2/gamma. */
static inline double eos_rho(double p, double rho0, double c0, double gamma)
{
    const double power = 1.0 + gamma * p / (rho0 * c0 * c0);
    return rho0 * (gamma == 1.0 ? power : pow(power, 1.0 / gamma));
}

#endif
