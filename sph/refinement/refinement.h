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

#include "apr_params.h"
#include "regions.h"

struct refinement {
    struct regions *regions;
    bool met;                        /* a region has come to the zones: it was said */
    bool local_steps;                /* each level has its own */
    int (*held)[APR_LEVELS_MAX + 1]; /* [BODIES_MAX]: cover.c; NULL before the first step */
    double added;       /* kg: to the mass of what flows, by changes of level; this rank */
    double mass0, gone; /* kg: of the fluid at the start, all ranks; removed since, this rank */
    double debt;        /* -: of the fluid's mass, what flows too much, at the last step */
    double grown;       /* m^dim: volume added by changes within this common step; this rank */
};

/* life.c: at the end of a step, with the slopes of its last stage: regions move to s->t, particles
 * are born and removed, all get their roles. At the start the finer levels have no particles: the
 * coarser ones give birth. s: the coarsest level. */
void refinement_adapt(struct sph *s);
/* The same at the start, one level after the other: settle may move the particles of a finer level
 * but those at its edge (ROLE_EDGE) before they give birth; NULL: all stay. */
void refinement_begin(struct sph *s, void (*settle)(struct sph *level));

/* Generations agree in number on average only, so mass comes and goes as they change places. In a
 * closed room all that flows pays it back, slowly; volumes too, so that densities stay. Collective.
 */
void refinement_repay(struct sph *s);
/* The mass of the fluid as it is now is that of the start. Collective. */
void refinement_remember(struct sph *s);
/* Local particle i of a level is about to be removed. */
void refinement_removed(struct sph *s, int i);

/* With local steps: the same for the levels finer than `outside', which stand at its time; regions
 * follow what these levels show. Particles of `outside' change roles as they enter or leave the
 * next region, and none of it is added or removed. s: the coarsest. Collective. */
void refinement_adapt_finer(struct sph *s, struct sph *outside);

/* A child of particle i of s in `to' (s, or its finer level), at its place + d: 1/2^D of its mass,
 * its fields with their slopes, rho by 5 % at most; the child's index. */
int refinement_child(const struct sph *s, struct sph *to, int i, const double *d);
/* For sph.flows_at: whether this level flows at x. */
bool refinement_flows_at(const struct sph *s, const double *x);

/* look.c: before the adaption: what regions follow, and at their times the criteria; of the lines
 * and slopes of the last stage. Collective. */
void refinement_look(struct sph *s);
/* What regions follow alone, as `outside' and finer levels show it. */
void refinement_follow(struct sph *s, struct sph *outside);
/* cover.c: after the regions have moved: says which body has left a region that held it. */
void refinement_watch_bodies(struct sph *s);
/* After the rates of a stage: of fluxes between what flows and guards nothing comes back, so that
 * mass would be lost; in a closed room it is shared out over what flows. Collective. */
void refinement_keep_mass(struct sph *s);
/* With local steps at the end of the common step instead: gained kg so, this rank. Collective. */
void refinement_spread_mass(struct sph *s, double gained);

void refinement_free(struct sph *s);

/* life.c: ", level n" of a scene that is refined, "" of others; valid until the next call. */
const char *sph_level_name(const struct sph *s);

#endif
