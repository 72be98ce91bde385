/* body_backs.h - bodies that stand where walls are solid, in 2D.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_BACKS_H
#define SPH_BODY_BACKS_H

#include "../sph.h"

/* Whether all corners of body k lie in rooms of the domain in which a wall shows its back. */
bool body_backs_shut_in(const struct scene *c, const struct sph_params *used, int k);
/* The same of a place inside the domain. */
bool body_backs_hold(const struct scene *c, const struct sph_params *used, const double *x);

#endif
