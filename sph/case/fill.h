/* fill.h - creates the first particles, on a lattice where the shapes have fluid.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

struct fill; /* the lattice and its waters, for the finer levels; NULL: there is none */
struct sph;

/* Creates the particles of the first level: lattice at cell centres in [lo, hi], u and p of the
 * case at t = 0, w = dx^D, m = rho(p) w. Returns the lattice for the functions below (FREE),
 * or NULL. Collective. */
struct fill *fill_lattice(struct sph *s);
/* Warns if the particles hold another amount of water than the shapes. Collective. */
void fill_check(struct sph *s, const struct fill *f);
/* Creates the first particles of the finer levels from the coarser ones, with the field of the
 * case. Collective. */
void fill_finer(struct sph *s, const struct fill *f);
