/* first_water.h - the water of the start by samples of the scene, before any particle is there.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

struct run;
struct sph_params;

/* Parts of the region of `used': water at the start (in the shapes, in no body or mesh, before the
 * open lines among the walls); what of the shapes' water is behind these lines; what of that has
 * nothing above it. */
struct first_water {
    double kept, behind, open;
};
/* By a few thousand samples, or where these find less than a particle at each place of one. */
struct first_water first_water_look(const struct run *r, const struct sph_params *used);
/* Warns where open lines leave out water that the shapes draw: more than half of it, or, with
 * nothing above it, 2 %. */
void first_water_warn(const struct run *r, const struct sph_params *used, struct first_water is);
