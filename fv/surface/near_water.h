/* near_water.h - cells near water: those that carry a velocity, what stencils read around them, and
 * drops that the surface does not resolve. All else is air, in which nothing is computed.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_NEAR_WATER_H
#define FV_NEAR_WATER_H

#include "../fv.h"

/* From the present layers: sets the ranges that FLOW_NEAR, BLOCK_NEAR and PART_NEAR visit, and
 * those of FLOW_WET, BLOCK_WET and PART_WET; clears cells that are no longer near. On uniform grids
 * and layers of unequal height with closed or periodic sides and rk3; elsewhere all cells are near.
 */
void near_water_find(struct fv *s);
/* Takes note of the former ranges; goes back to them, and clears cells that have become near since.
 * The values of those that were near are the caller's to restore. */
void near_water_keep(struct fv *s);
void near_water_back(struct fv *s);

#endif
