/* wall_rims.h - what closes the sums of a particle at rims of thin walls.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_RIMS_H
#define SPH_WALL_RIMS_H

#include "wall_list.h"

/* The vector, 1/m, that the pressure of the k-th particle of the list acts with at rims; in `to',
 * or the list's own. */
const double *wall_rims_close(const struct sph *s, const struct wall_list *l, int k, double to[3]);

#endif
