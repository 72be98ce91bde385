/* solids.h - bodies and walls of a scene among several programs of particles, each with its own
 * box: each belongs to the program in whose box it lies. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SOLIDS_H
#define COMMON_SOLIDS_H

#include "../scene/scene_mesh.h"
#include "run.h"

/* Whether body or wall k lies wholly in the box of another program of this kind at the start. Sides
 * of the domain are everybody's. Collective over r->comm. */
bool solids_elsewhere(const struct run *r, enum mesh_owner owner, int k);
/* Takes those out of the scene; once the case has been checked, for what is left is counted anew.
 * Collective over r->comm. */
void solids_deal(struct run *r);

#endif
