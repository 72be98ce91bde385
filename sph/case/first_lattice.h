/* first_lattice.h - the lattice of the first particles of a level: its cells, where walls and
 * bodies leave room for a particle, and the particle there.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"
#include "lattice.h"

struct exact;

/* Number of cells along an axis of a region from lo to hi, m; and the lattice's lower end along
 * axis a, m: the lower corner, or the one that fits the upper corner where only that has a wall of
 * the domain. The last cell may reach out of a domain that dx does not divide. */
double first_lattice_cells(double lo, double hi, double dx);
double first_lattice_begin(const struct scene *c, int a, double lo, double hi, double dx);
/* The lattice of level s, with no cell filled; freed by FREE. */
struct lattice first_lattice_create(const struct sph *s);
/* A rank's part, from lo to hi, m, and the range first <= i < last of cells whose centre may be in
 * it. */
void first_lattice_own(const struct domain *part, const struct lattice *l, int dim, double lo[3],
                       double hi[3], int first[3], int last[3]);
/* Calls `at' for each cell whose centre is in this rank's part. */
void first_lattice_each_own(struct sph *s, const struct lattice *l,
                            void (*at)(struct sph *s, const struct lattice *l, int64_t cell,
                                       const double *centre, void *ctx),
                            void *ctx);
/* Calls `at' for the centres, m, of the cells in and around a rank's part. */
void first_lattice_each_near(const struct sph *s, const struct domain *part,
                             void (*at)(const double *centre, double dx, void *ctx), void *ctx);
/* Whether x is within the domain and the closed lines of its walls, and in no body; meshes that
 * separate rooms are not considered. */
bool first_in_walls(const struct sph *s, const double *x);
/* Whether walls and bodies leave room for a particle of this level at x. */
bool first_has_room(const struct sph *s, const double *x);
/* Adds the first particle at x, m, with the velocity and pressure of the case there; volume in
 * units of dx^dim. Returns its index. */
int first_add(struct sph *s, const struct exact *e, int64_t id, const double *x, double volume);
/* Removes this rank's particles that packing has pressed into seams of walls narrower than dx. */
void first_clear_seams(struct sph *s);
