/* seal_openings.h - through which openings water seeps to points between solids, see there.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SEAL_OPENINGS_H
#define SPH_SEAL_OPENINGS_H

#include "seal_point.h"

/* Sets `opening' of the points of the rim among the n, -1 elsewhere, and `from' of all, the share
 * that each opening has in the water there: 1 for the one with the least resistance. */
void seal_openings_find(const struct sph *s, struct seal_point *of, int n);

#endif
