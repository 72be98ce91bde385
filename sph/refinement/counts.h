/* counts.h - population control of guards: keeps as many guards as there are flowing particles
 * beside them. Both generations are moved apart by what bounds and shifts each; guards near the
 * outer edge drift out while no parent enters. Where children are missing beside parents that flow
 * some are created, where there are too many some are removed. None of them flows, so that this
 * makes no mass; it keeps the mass that begins to flow equal to the mass that ceases to. The number
 * of parents is left alone: that of the coarsest level keeps the mass in the end.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_COUNTS_H
#define SPH_COUNTS_H

#include "../sph.h"

/* Every few steps after guards_list, for s and all finer levels: lists which guards are to be
 * created (guards.created) and marks those to be removed (ROLE_SURPLUS) at the end of the step.
 * Collective. */
void counts_mark(struct sph *s);

#endif
