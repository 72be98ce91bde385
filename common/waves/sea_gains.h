/* sea_gains.h - the correction that each component of a sea needs in its zone (zone_gain.h),
 * interpolated from some frequencies and directions.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SEA_GAINS_H
#define COMMON_SEA_GAINS_H

#include "imposed_waves.h"

/* Factor of the velocities at one angular frequency, rad/s, and wave number, 1/m, whose direction
 * has that cosine with the side's normal, that corrects for the zone; 1 without a zone. */
double _Complex sea_gain(const struct wave_spec *of, double omega, double k, double cosine);

/* The factor of a closed side made that of one through which the waves' flux goes (wave_spec.open):
 * as a piston it makes the share p = 4 sinh^2 kh/(kh (sinh 2kh + 2kh)) of them by itself, and all
 * else is in proportion to what is left. */
double _Complex sea_gain_open(const struct wave_spec *of, double k, double _Complex gain);

struct sea_gains;

/* A table for angular frequencies from low to high, rad/s; owned by the caller (FREE). */
struct sea_gains *sea_gains_create(const struct wave_spec *of, double low, double high);
/* Factor of velocities ~ e^(i omega t) of waves whose direction has this cosine with the side's
 * normal. */
double _Complex sea_gains_at(const struct sea_gains *is, double omega, double cosine);

#endif
