/* wave_pressure.h - the pressure under imposed waves. It follows from their velocities alone, which
 * have no rotation: with w upwards and both the current and the waves in u,
 *   p(z)/rho = g (eta - z) + integral of dw/dt from z to eta + (|u(eta)|^2 - |u(z)|^2)/2,
 * so that it is 0 on the surface. Of a wave of permanent form the integral is known, from the
 * velocity that is steady in its frame; of sums its rate comes from the frames of their tables.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_PRESSURE_H
#define COMMON_WAVE_PRESSURE_H

#include "imposed_waves.h"

/* Of sums, at the time of waves_at, after their table: fills the table of the integral from the
 * frames, `share' (0 to 1) of a frame after the second of weight 4. */
void wave_pressure_frame(struct waves *w, double share);

#endif
