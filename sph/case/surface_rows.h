/* surface_rows.h - first particles in rows that end at the free surface of the shapes, whatever its
 * slope. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SURFACE_ROWS_H
#define SPH_SURFACE_ROWS_H

#include "../../common/scene/exact.h"
#include "../sph.h"

/* Whether the scene has free surfaces that a lattice meets in steps, or between two rows. */
bool surface_rows_wanted(const struct sph *s);
/* Moves x, the centre of a cell of the lattice of this level, to where its particle starts; its
 * volume over dx^D; 0: the shapes have no water at its centre, or end there. */
double surface_rows_place(const struct sph *s, const struct exact *e, double *x);
/* How far the surface is from the face of the last cell of a row, with its centre at x, m, along
 * the axis; 0: the row stays as it is. sign: which end. */
double surface_rows_shift(const struct sph *s, const struct exact *e, const double *x, int axis,
                          int sign);
/* Of a finer level, after its birth: near a free surface children stand as their mothers' rows end;
 * they give way to a lattice of their own spacing with rows of its own. */
void surface_rows_renew(struct sph *s);

#endif
