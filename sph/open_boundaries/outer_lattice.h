/* outer_lattice.h - the particles that the lattice would have behind the faces of the open sides,
 * as ghosts, so that supports near them are full.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_OUTER_LATTICE_H
#define SPH_OUTER_LATTICE_H

#include "../sph.h"

/* Adds them, with the outer solution, behind the ghosts of the halo. After domain_ghosts. */
void outer_lattice_ghosts(struct sph *s);
/* Updates their packed records to s->t. */
void outer_lattice_move(struct sph *s);

#endif
