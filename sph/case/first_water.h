/* first_water.h - the water of the start by samples of the scene, before any particle is there.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_FIRST_WATER_H
#define SPH_FIRST_WATER_H

struct run;
struct sph_params;

/* Part of the region of `used' that is water at the start: in the shapes, in no body or mesh,
 * before the open lines among the walls. By a few thousand samples. */
double first_water_share(const struct run *r, const struct sph_params *used);
/* Warns where open lines leave out water that the shapes draw: more than half of it, or, with
 * nothing above it, 2 %. */
void first_water_warn(const struct run *r, const struct sph_params *used);

#endif
