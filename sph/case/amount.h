/* amount.h - compares the water that the first particles hold with that in the shapes.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "lattice.h"

/* Warns where the particles of the first level, with volumes, hold 0.5 % more or less than the
 * shapes do in the cells that are filled or beside filled ones. Not for rooms separated by meshes,
 * whose volumes are scaled to the room, nor for regions with open sides, which are filled up.
 * Collective. */
void amount_check(struct sph *s, const struct lattice *l);
