/* pack.h - rearrangement of the first particles between walls.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PACK_H
#define SPH_PACK_H

struct sph;

/* Takes so many steps of it; 0: none. Collective. */
void pack_start(struct sph *s, int steps);
/* Of a finer level, but for those at its edge, after its birth of one that was packed. */
void pack_finer(struct sph *level);

#endif
