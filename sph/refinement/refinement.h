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

#include "regions.h"

struct refinement {
    struct regions *regions;
    double added;  /* kg: to the mass of what flows, by changes of level; this rank */
    double repaid; /* kg: of that, taken back from what flows; all ranks */
};

/* life.c: at the end of a step, with the slopes of its last stage: regions move to s->t, particles
 * are born and removed, all get their roles. At the start the finer levels have no particles: the
 * coarser ones give birth. s: the coarsest level. */
void refinement_adapt(struct sph *s);

/* Generations agree in number on average only, so mass comes and goes as they change places. In a
 * closed room all that flows pays it back, slowly, for rows of a lattice that cross an edge
 * together owe for some steps only; volumes too, so that densities stay. Collective. */
void refinement_repay(struct sph *s);

/* look.c: before the adaption: what regions follow, and at their times the criteria; of the lines
 * and slopes of the last stage. Collective. */
void refinement_look(struct sph *s);
/* After the rates of a stage: of fluxes between what flows and guards nothing comes back, so that
 * mass would be lost; in a closed room it is shared out over what flows. Collective. */
void refinement_keep_mass(struct sph *s);

void refinement_free(struct sph *s);

#endif
