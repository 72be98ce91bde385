/* body_backs.h - bodies that stand where walls are solid, in 2D.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_BACKS_H
#define SPH_BODY_BACKS_H

#include "../sph.h"

/* Of n points x, m, the first that does not lie in a room of the domain in which a wall shows its
 * back; n: all do. */
int body_backs_first_open(const struct scene *c, const struct sph_params *used, int n,
                          const double (*x)[2]);

#endif
