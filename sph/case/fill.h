/* fill.h - the first particles, on a lattice where the shapes have fluid.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_FILL_H
#define SPH_FILL_H

struct fill; /* the lattice and its waters, for the finer levels; NULL: there is none */
struct sph;

/* Lattice at cell centres in [lo, hi], exact u and p at t = 0, w = dx^D, m = rho(p) w. */
struct fill *fill_lattice(struct sph *s);
/* Says so where the particles hold another amount of water than the shapes. Collective. */
void fill_check(struct sph *s, const struct fill *f);
void fill_free(struct fill **f);
/* The first particles of the finer levels: born of the coarser ones, with the exact field. */
void fill_finer(struct sph *s, const struct fill *f);

#endif
