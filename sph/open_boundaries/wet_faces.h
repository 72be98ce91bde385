/* wet_faces.h - open sides that stand in water and in air: which share of a face the water outside
 * wets, where births and the lattice behind the faces end below the surface, and what becomes of
 * particles that leave above it. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WET_FACES_H
#define SPH_WET_FACES_H

#include "openings.h"

/* o->share of all faces at time t, the same on all ranks. */
void wet_faces_find(struct sph *s, double t);
/* Share below phi = 0 of a face of side dx, by the plane through its centre; g: gradient of phi. */
double wet_faces_share(int dim, int axis, double dx, double phi, const double *g);
/* The face that takes the mass of a particle leaving by `side' at x: that there, or the topmost wet
 * one below. -1: none, it is a drop over the water. */
int wet_faces_for(struct sph *s, int side, const double *x);
/* Counts a particle with the state y as such: mass, momentum, and of them what runs as a film along
 * a wall. */
void wet_faces_rain(struct sph *s, const double *y);
/* kg: air cavities that crossed the open sides: deficits of faces beyond openings_most_debt. */
double wet_faces_voids(const struct sph *s);
/* Moves the n places x[n][3] at s->t to at least `depth' below the surface, m. */
void wet_faces_lower(struct sph *s, double depth, int n, double *x);
/* Of the lattice behind the faces what is water, none higher than dx/2 below the surface. */
void wet_faces_ghosts(struct sph *s);
/* m^dim: what zones_counted_box holds, with drops on their way over the water outside; drops that
 * have left since the start. Collective. */
void wet_faces_water(struct sph *s, double water[2]);
void wet_faces_save(const struct openings *o, struct h5 *f);
bool wet_faces_load(struct sph *s, struct h5 *f);

#endif
