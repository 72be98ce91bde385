/* pack.h - rearranges the first particles between walls so that they fill the room uniformly.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

struct sph;

/* Takes up to so many steps of rearrangement; 0: none. Nothing flows meanwhile. Collective. */
void pack_start(struct sph *s, int steps);
/* The same for a finer level, without its edge, after it was created from a level that was
 * rearranged. Collective. */
void pack_finer(struct sph *level);
