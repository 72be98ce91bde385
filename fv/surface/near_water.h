/* near_water.h - cells near water: those that carry a velocity, what stencils read around them, and
 * drops that the surface does not show. All else is air, in which nothing happens.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_NEAR_WATER_H
#define FV_NEAR_WATER_H

#include "../fv.h"

/* From the layers of the surface as it is: what FLOW_NEAR, BLOCK_NEAR and PART_NEAR visit, and what
 * was near and is no more is emptied. On uniform grids and graded layers with closed or periodic
 * sides and rk3; elsewhere all cells are near. */
void near_water_find(struct fv *s);
void near_water_free(struct fv *s);

#endif
