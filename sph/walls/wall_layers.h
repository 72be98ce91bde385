/* wall_layers.h - how the layers of a lattice behind a plane wall fill a kernel, compared with the
 * integral over the half space behind it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_LAYERS_H
#define SPH_WALL_LAYERS_H

#include "../sph.h"

/* ratio[k], k = 0 .. n, for a particle at k/n R before a plane wall: sum w W over lattice layers
 * that follow each other from dx/2 behind the wall on, over the sum of the whole lattice, divided
 * by the integral of W behind the wall. In a lattice that ends dx/2 before a wall, sum w W over
 * that of the whole lattice is 1 minus this ratio times what the wall takes from the Shepard
 * factor; the Shepard factor alone is off by 3 % in the first layer with R = 2.5 dx. */
void wall_layers_rooms(const struct sph *s, int n, double *ratio);
/* The same for the crowding vector: ratio[0..n] of the push of such layers over int W dS of the
 * plane. */
void wall_layers_crowding(const struct sph *s, int n, double *ratio);
/* What a plane pushes with by the crowding vector, over int W of it, likewise. Between sides it is
 * that of layers behind them, so that those before them rest in their places: by the integral the
 * first three rest at 0.497, 1.516 and 2.516 dx, which is a tenth of a percent of Poiseuille flow.
 * Behind other faces no layers of a lattice would stand: packed before a ball the nearest particle
 * is 0.11 dx from it instead of 0.25. Under a surface, where the shift follows the speed, water at
 * rest is a fifth less still with layers. */
void wall_layers_tabulate(const struct sph *s, int n, double *ratio);
/* 1/m: int W dS of a plane at the height h, m. */
double wall_layers_plane(const struct sph *s, double h);

#endif
