/* wall_layers.h - what layers of a lattice behind a plane wall have of a kernel, against the
 * integral over all that is there. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_LAYERS_H
#define SPH_WALL_LAYERS_H

#include "../sph.h"

/* ratio[k], -, k = 0 .. n: of a particle k/n R before a plane wall, sum w W over layers that follow
 * each other from dx/2 behind the wall on, over the lattice's whole sum, divided by int W dV behind
 * the wall. In a lattice that ends dx/2 before a wall, 1 less what walls take from the Shepard
 * factor times this is sum w W over the lattice's, which the Shepard factor alone is not: by 3 % in
 * the first row with R = 2.5 dx. */
void wall_layers_rooms(const struct sph *s, int n, double *ratio);

#endif
