/* sea.h - irregular waves as sums of components: JONSWAP's spectrum with random phases (a sea), or
 * with all crests at one place and time (a focused group); their velocity tables.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SEA_H
#define COMMON_SEA_H

#include <stdint.h>

#include "imposed_waves.h"

/* A random number from 0 to 1 by splitmix64 from *state, which goes on: the same sea on every
 * machine. */
double sea_uniform(uint64_t *state);
/* JONSWAP's spectrum divided by A f_p^-5, f in units of the peak's frequency f_p. */
double sea_jonswap(double f, double gamma);
/* Spectral density of a sea at f Hz, m^2/Hz; 0 outside of the range of its components. */
double sea_spectrum(const struct wave_spec *of, double f);
/* The components, by frequency from half to three times that of the peak, 1/repeat apart; *n of
 * them, owned by the caller (mem_free). period: of the peak, s. Sea: sum a^2/2 is height^2/16;
 * focused: sum a is half the height. */
struct wave_component *sea_components(const struct wave_spec *of, double period, int *n);
/* Completes w, whose `of' is set, for the kinds sea and focused. */
void sea_make(struct waves *w);
/* Prepares the table of w for the time t, s: linear theory, with bound waves where there is second
 * order. */
void sea_at(struct waves *w, double t);
/* Estimated computing time of one period of these waves on one rank, s. */
double sea_seconds(const struct waves *w);
/* Depth, m, down to which a velocity table is needed for waves of that length, m, over that depth,
 * m. */
double sea_reach(double depth, double length);

#endif
