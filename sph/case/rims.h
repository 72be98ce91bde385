/* rims.h - open edges of meshes that the first particles reach.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "lattice.h"

/* Ends the run, with the position, if a mesh that is open and not thin ends in the first fluid:
 * water that comes round the edge finds no wall on its back. Holes smaller than dx do not count,
 * nor edges on sides of the domain or on other meshes. */
void rims_check(const struct sph *s, const struct lattice *l);
