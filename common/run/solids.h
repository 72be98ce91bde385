/* solids.h - deals out the bodies and walls of a scene to several programs of particles, each with
 * its own box: a solid belongs to the program in whose box it lies.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../scene/scene.h"
#include "program.h"

/* Whether body or wall k (owner says which) lies wholly in the box of another program of this kind
 * at the start. Sides of the domain belong to every program. Collective over r->comm. */
bool solids_elsewhere(const struct run *r, enum mesh_owner owner, int k);
/* Removes those solids from the scene and renumbers the others; gauges on bodies go with them. To
 * be called once the case has been checked, since messages name solids by their index in the case.
 * Collective over r->comm. */
void solids_deal(struct run *r);
