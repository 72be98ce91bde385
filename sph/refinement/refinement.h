/* refinement.h - adaptive particle refinement (Chiron, thesis 2017, chapter 5; Chiron et al., J.
 * Comput. Phys. 354, 2018). Each level n of spacing dx/2^n is a struct sph of its own, with its own
 * list of pairs, walls, surface and halo; s->finer leads from one to the next. In every place one
 * level flows, the others have guards there, which take their fields from those that flow:
 *   outside B_n          level n - 1 flows
 *   0 < d_n < R_(n-1)    level n - 1 flows, level n has guards
 *   d_n >= R_(n-1)       level n flows, level n - 1 has guards
 * with d_n the distance to the edge of the region B_n (regions.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_REFINEMENT_H
#define SPH_REFINEMENT_H

#include "../sph.h"
#include "regions.h"

struct refinement {
    struct regions *regions;
    double added; /* kg: mass of what flows, by births, removals and changes of status */
};

/* Places in the levels that a particle of level n may have. */
struct standing {
    int role;   /* ROLE_GUARD, ROLE_DEEP, ROLE_EDGE */
    int source; /* of a guard: the finer of the two levels that its fields come from */
};
struct standing refinement_standing(const struct sph *base, int level, const double *x);

/* life.c: at the end of a step, with the slopes of its last stage: regions move to s->t, particles
 * are born and removed, all get their roles. At the start the finer levels have no particles: the
 * coarser ones give birth. s: the coarsest level. */
void refinement_adapt(struct sph *s);

/* look.c: before the adaption: what regions follow, and at their times the criteria; of the lines
 * and slopes of the last stage. Collective. */
void refinement_look(struct sph *s);

void refinement_free(struct sph *s);

#endif
