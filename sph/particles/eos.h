/* eos.h - Tait's equation of state [1.8-1.9] with gamma 7 or 1,
 *   p = rho0 c0^2/gamma ((rho/rho0)^gamma - 1),   c = c0 (rho/rho0)^((gamma - 1)/2).
 * Pressures in Pa, 0 at rho0; densities in kg/m^3.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <math.h>

/* Pressure at the density rho. */
static inline double eos_p(double rho, double rho0, double c0, double gamma)
{
    const double r = rho / rho0, r2 = r * r;
    return gamma == 1.0 ? c0 * c0 * (rho - rho0) : rho0 * c0 * c0 / 7.0 * (r2 * r2 * r2 * r - 1.0);
}

/* Speed of sound at the density rho, m/s. */
static inline double eos_c(double rho, double rho0, double c0, double gamma)
{
    const double r = rho / rho0;
    return gamma == 1.0 ? c0 : c0 * r * r * r;
}

/* Inverse of eos_p. With gamma 7 a pressure so low that no density fits counts as just above
 * that. */
static inline double eos_rho(double p, double rho0, double c0, double gamma)
{
    const double s = 1.0 + gamma * p / (rho0 * c0 * c0);
    return gamma == 1.0 ? rho0 * s : rho0 * pow(s > 1e-3 ? s : 1e-3, 1.0 / 7.0);
}

/* Pressure whose enthalpy, the integral of dp/rho from 0, equals p/rho0, that of a flow of constant
 * density at pressure p: gradients over density are then the same, and so is the hydrostatic
 * state. */
static inline double eos_p_from_constant(double p, double rho0, double c0, double gamma)
{
    const double s = p / (rho0 * c0 * c0), t = 1.0 + 6.0 * s;
    const double r = gamma == 1.0 ? exp(s) : pow(t > 1e-3 ? t : 1e-3, 1.0 / 6.0);
    return eos_p(rho0 * r, rho0, c0, gamma);
}
