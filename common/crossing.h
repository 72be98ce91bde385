/* crossing.h - coupled jobs whose free surface crosses open sides of SPH's box: both programs have
 * a part of it, and of one pressure that is 0 on it. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_CROSSING_H
#define COMMON_CROSSING_H

#include "run.h"

/* From the case alone, so that both programs say the same: the water has a surface, gravity holds
 * it down, and sph.box (or sph.free) ends inside the domain along an axis across gravity.
 * Collective over r->comm. */
bool crossing_find(const struct run *r);

#endif
