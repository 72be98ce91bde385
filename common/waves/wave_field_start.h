/* wave_field_start.h - the initial state of a wave field: the components that a periodic line or
 * plane can hold, and their bound waves.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_FIELD_START_H
#define COMMON_WAVE_FIELD_START_H

#include "evolution.h"
#include "imposed_waves.h"

/* The components of JONSWAP's spectrum among the grid's modes, from half to three times the peak's
 * frequency and of at most `highest', 1/m, by |k|; *n of them, owned by the caller (mem_free). Sea:
 * sum a^2/2 is height^2/16; focused: sum a is half the height. */
struct wave_component *wave_field_components(const struct wave_spec *of, double period,
                                             const struct wave_grid *g, double highest, int *n);
/* Modes z[cells][2] of eta + i phi_s at the time t, s, to first and second order. */
void wave_field_modes(const struct wave_grid *g, const struct wave_component *of, int n,
                      const struct evolution_spec *in, double t, double *z);

#endif
