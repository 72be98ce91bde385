/* rooms.h - the rooms into which meshes separate the first lattice: where they leave a particle
 * room, between which neighbours they stand, and whether a room is on the fluid's side of them all.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "lattice.h"

/* Whether meshes of files are in the lattice at all. */
bool rooms_parted(const struct sph *s);
/* Whether meshes leave room for a particle at x, on whichever side. */
bool rooms_have_place(const struct sph *s, const double *x);
/* Whether a mesh stands between a and b, or leaves no room at b. */
bool rooms_blocked(const struct sph *s, const double *a, const double *b);
/* Whether a mesh stands between a and b. */
bool rooms_crossed(const struct sph *s, const double *a, const double *b);
/* Distance of x from the nearest mesh, m, at most reach. */
double rooms_distance(const struct sph *s, const double *x, double reach);
/* Whether x is within reach of a mesh of a file. */
bool rooms_are_near(const struct sph *s, const double *x, double reach);
/* Sets l->cut between the cells in [first, last) and their filled neighbours; lattice_share
 * combines the ranks afterwards. */
void rooms_cut_links(const struct sph *s, struct lattice *l, const int *first, const int *last);
/* Whether x is on the fluid's side of all meshes, by their winding numbers. A point so open that
 * they do not tell ends the run: it needs a seed (initial.seed). */
bool rooms_are_wet(const struct sph *s, const double *x);
/* The same, for a few cells, by the nearest mesh alone. */
bool rooms_are_before(const struct sph *s, const double *x);
/* Ends the run if a and b, of one room, lie on two sides of a mesh that is open and not thin. */
void rooms_refuse_sheet(const struct sph *s, const double *a, const double *b);
