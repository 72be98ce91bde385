/* rk3.h - coefficients of the three-stage low-storage Runge-Kutta scheme of Spalart, Moser & Rogers
 * (J. Comput. Phys. 96, 1991). SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_RK3_H
#define FV_RK3_H

static const double rk3_alpha[3] = {29.0 / 96.0, -3.0 / 40.0, 1.0 / 6.0};
static const double rk3_beta[3] = {37.0 / 160.0, 5.0 / 24.0, 1.0 / 6.0};
static const double rk3_gamma[3] = {8.0 / 15.0, 5.0 / 12.0, 3.0 / 4.0};
static const double rk3_zeta[3] = {0.0, -17.0 / 60.0, -5.0 / 12.0};
static const double rk3_at[3] = {8.0 / 15.0, 2.0 / 3.0, 1.0}; /* stage times over dt */

#endif
