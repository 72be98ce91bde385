/* surface_rows.h - places the first particles so that lattice rows end at the free surface of the
 * shapes, whatever its slope.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/scene/scene.h"
#include "../sph.h"

/* Whether the scene has free surfaces that cross the lattice in steps or lie between two of its
 * rows. */
bool surface_rows_wanted(const struct sph *s);
/* Moves x, the centre of a cell of this level's lattice, to where its particle starts, and returns
 * the particle's volume in units of dx^D; 0: the shapes have no water at its centre, or end
 * there. */
double surface_rows_place(const struct sph *s, const struct exact *e, double *x);
/* Distance of the surface from the face of the last cell of a row, whose centre is x, m, along the
 * axis; 0: the row stays as it is. sign: which end. */
double surface_rows_shift(const struct sph *s, const struct exact *e, const double *x, int axis,
                          int sign);
/* For a finer level after its creation: near a free surface children are arranged as the rows of
 * their parents end; they are replaced by a lattice of their own spacing with rows of its own. */
void surface_rows_renew(struct sph *s);
