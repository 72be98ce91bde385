/* coupling_solids.h - bodies, lines and surfaces of triangles in a coupled job: FV knows of none,
 * so they must lie where SPH gives the flow. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_COUPLING_SOLIDS_H
#define SPH_COUPLING_SOLIDS_H

#include "../sph.h"

/* The part of the given box that fv does not look at: two cells within it. */
void coupling_hidden(const struct run *r, const struct sph_params *prm, double box[2][3]);
/* Faults of bodies that leave what SPH gives, and of walls that FV's stencils, two cells deep in
 * it, meet. */
void coupling_check_bodies(const struct run *r, const struct sph_params *prm, struct faults *f);
void coupling_check_walls(const struct run *r, const struct sph_params *prm, struct faults *f);

#endif
