/* sea.h - irregular waves as sums: JONSWAP's spectrum with random phases, or all crests at one
 * place and time; frames of them. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SEA_H
#define COMMON_SEA_H

#include <stdint.h>

#include "waves.h"

/* From 0 to 1, by splitmix64: the same sea on every machine. */
double sea_uniform(uint64_t *state);
/* JONSWAP's spectrum over A f_p^-5, f in units of f_p, -. */
double sea_jonswap(double f, double gamma);
/* m^2/Hz: of a sea at f Hz; 0 beyond its components. */
double sea_spectrum(const struct wave_spec *of, double f);
/* The components, by frequency from half to three times that of the peak, 1/repeat apart; their
 * number in n; owned by the caller. Sea: sum a^2/2 is height^2/16; focused: sum a is half the
 * height. */
struct wave_component *sea_components(const struct wave_spec *of, double period, int *n);
/* Fills in the waves of a sea or a group. */
void sea_make(struct waves *w);
/* Makes its table ready for the time t, s: linear theory, and of second order what pairs bind. */
void sea_at(struct waves *w, double t);
/* s: of computing that a period of them costs, about. */
double sea_seconds(const struct waves *w);
/* m: as deep as a table reaches for waves of that length. */
double sea_reach(double depth, double length);

#endif
