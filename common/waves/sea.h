/* sea.h - irregular waves as sums of linear ones: JONSWAP's spectrum with random phases, or all
 * crests at one place and time. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SEA_H
#define COMMON_SEA_H

#include "waves.h"

/* JONSWAP's spectrum over A f_p^-5, f in units of f_p, -. */
double sea_jonswap(double f, double gamma);
/* The components, by frequency from half to three times that of the peak, 1/repeat apart; their
 * number in n; owned by the caller. Sea: sum a^2/2 is height^2/16; focused: sum a is half the
 * height. */
struct wave_component *sea_components(const struct wave_spec *of, double period, int *n);
/* What they make of a flat table's nodes; owned by the caller. */
double *sea_profiles(const struct waves *w);
/* Fills a table at the time t, s: linear theory, above the still level as on it. */
void sea_frame(const struct waves *w, double t, struct wave_table *to);

#endif
