/* runge_kutta.c - coefficients of the Runge-Kutta schemes: classical RK4 and two of three stages,
 * j3. Applied to y' = lambda y with z = lambda dt, RK4 has the polynomial 1 + z + z^2/2 + z^3/6 +
 * z^4/24, j3 is 1 + z + z^2/2 + c z^3 with c = ahead_0 ahead_1.
 *
 * The Riemann schemes' spectrum is long on the real axis, for the pressure jump between neighbours
 * is dissipated, and shorter on the imaginary one. j3 is of order 2 in three stages. c = 0.0625 is
 * best on the real axis alone, 1/6 on the imaginary one, where waves grow by (1/4 - 2 c) y^4/2 a
 * step: with 0.095 the arms of an inviscid patch, where nothing damps waves, gain energy at c dt/R
 * = 0.5, with 0.11 at 0.55, with 0.125 not yet; with full dissipation the limits (square lattice,
 * all wave vectors) are 0.62, 0.58, 0.55, in 3D 0.60, 0.53, 0.48. 0.115 is between; a step at 0.5
 * is 0.17 of R/c an evaluation, RK4's at 0.375 0.094. The central schemes have an imaginary
 * spectrum: there c is 1/6, stable to 1.73 i.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "runge_kutta.h"

#include "../particles/sph_particles.h"

static const struct rk_stages rk4 = {.name = "rk4",
                                     .n = 4,
                                     .at = {0.0, 0.5, 0.5, 1.0},
                                     .ahead = {0.5, 0.5, 1.0},
                                     .weight = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0},
                                     .real_axis = 2.785};
/* c = 0.23 * 0.5 = 0.115 */
static const struct rk_stages j3_upwind = {.name = "j3",
                                           .n = 3,
                                           .at = {0.0, 0.23, 0.5},
                                           .ahead = {0.23, 0.5},
                                           .weight = {0.0, 0.0, 1.0},
                                           .real_axis = 3.3};
/* c = 1/3 * 1/2 = 1/6: the polynomial is that of order 3 */
static const struct rk_stages j3_central = {.name = "j3",
                                            .n = 3,
                                            .at = {0.0, 1.0 / 3.0, 0.5},
                                            .ahead = {1.0 / 3.0, 0.5},
                                            .weight = {0.0, 0.0, 1.0},
                                            .real_axis = 2.51};

const struct rk_stages *stages_of(int integrator, int scheme)
{
    if (integrator == INTEGRATOR_RK4)
        return &rk4;
    return sph_params_is_riemann(scheme) ? &j3_upwind : &j3_central;
}
