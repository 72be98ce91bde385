/* coupling_solids.h - bodies, lines and surfaces of triangles in a coupled job: FV does not know
 * them, so they must lie where SPH provides the flow.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_COUPLING_SOLIDS_H
#define SPH_COUPLING_SOLIDS_H

#include "../sph.h"

/* The part of SPH's box whose contents FV does not use, m: two cells inside it. */
void coupling_hidden(const struct run *r, const struct sph_params *prm, double box[2][3]);
/* Adds faults for bodies that leave this part, and for walls that FV's stencils, two cells deep in
 * the box, meet. */
void coupling_check_bodies(const struct run *r, const struct sph_params *prm, struct faults *f);
void coupling_check_walls(const struct run *r, const struct sph_params *prm, struct faults *f);

#endif
