/* sea_gains.h - what each component of a sea makes up for its zone (zone_gain.h), from some
 * frequencies and directions. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SEA_GAINS_H
#define COMMON_SEA_GAINS_H

#include <complex.h>

#include "waves.h"

/* Factor of the velocities of one frequency, at that cosine with the side's normal, that makes up
 * for the zone; 1 without one. */
double complex sea_gain(const struct wave_spec *of, double omega, double k, double cosine);

struct sea_gains;

/* For angular frequencies from low to high, 1/s; owned by the caller. */
struct sea_gains *sea_gains_create(const struct wave_spec *of, double low, double high);
void sea_gains_free(struct sea_gains **is);
/* Factor of velocities ~ e^(i omega t) of waves whose direction has this cosine with the side's
 * normal. */
double complex sea_gains_at(const struct sea_gains *is, double omega, double cosine);

#endif
