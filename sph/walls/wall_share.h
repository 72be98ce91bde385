/* wall_share.h - who gets what the sum over pairs loses where gamma divides it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_SHARE_H
#define SPH_WALL_SHARE_H

#include "wall_list.h"

/* Credits the force `lost' of the k-th particle of the list, at x, to the bodies and walls near it;
 * all of it, whatever they are. */
void wall_share_out(const struct sph *s, const struct wall_list *l, int k, const double *x,
                    const double *lost);

#endif
