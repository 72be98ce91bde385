/* wet_faces.h - open sides that stand partly in water and partly in air: which fraction of a face
 * the water outside wets, so that creation and the lattice behind the faces end below the surface,
 * and what becomes of particles that leave above it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WET_FACES_H
#define SPH_WET_FACES_H

#include "openings.h"

/* Sets share of all faces at time t, s; the same on all ranks, without communication. */
void wet_faces_find(struct sph *s, double t);
/* Fraction below phi = 0 of a face of edge dx, m, by the plane through its centre; g: gradient of
 * phi. */
double wet_faces_share(int dim, int axis, double dx, double phi, const double *g);
/* The face that takes the mass of a particle that leaves through `side' at x: that there, or the
 * topmost wet one below. -1: there is none, it is a drop over the water. */
int wet_faces_for(struct sph *s, int side, const double *x);
/* Counts a particle with the state y as such a drop: mass, momentum, and the part that runs as a
 * film along a wall. */
void wet_faces_rain(struct sph *s, const double *y);
/* Mass of air cavities that crossed the open sides, kg: deficits of faces beyond
 * openings_max_deficit. */
double wet_faces_voids(const struct sph *s);
/* Moves the n points x[n][3] at s->t so that they are at least `depth', m, below the surface. */
void wet_faces_lower(struct sph *s, double depth, int n, double *x);
/* Removes from the lattice behind the faces what is not water; the rest is no higher than dx/2
 * below the surface. */
void wet_faces_ghosts(struct sph *s);
/* water[0], m^dim: volume in zones_counted_box with drops that are over the water outside;
 * water[1]: drops that have left since the start. Collective. */
void wet_faces_water(struct sph *s, double water[2]);
/* Restart files, written or read; false: the file has none that fit. */
bool wet_faces_restart(struct openings *o, struct h5 *f);

#endif
