/* mean_velocity.h - momentum of a coupled flow in a wholly periodic domain.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MEAN_VELOCITY_H
#define FV_MEAN_VELOCITY_H

#include "../fv.h"

/* Whether the mean velocity of this flow is known at any time: all sides are periodic, nothing
 * solid and no surface is in the domain, the start's mean is that of the scene, and the cells are
 * those of fv.cells. */
bool mean_velocity_is_known(const struct fv *s);
/* Relaxes the mean velocity of the computed cells towards it, at the end of a coupling step; where
 * mean_velocity_is_known. Collective. */
void mean_velocity_relax(struct fv *s);

#endif
