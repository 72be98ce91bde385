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

/* What is common to all levels; the coarsest level has it. */
struct refinement {
    struct regions *regions;
    bool met;                        /* a region has met the zones, which has been logged */
    bool local_steps;                /* each level has its own */
    int (*held)[APR_LEVELS_MAX + 1]; /* [BODIES_MAX]: cover.c; NULL before the first step */
    double added;       /* kg: to the mass of what flows, by changes of level; this rank */
    double mass0, gone; /* kg: of the fluid at the start, all ranks; removed since, this rank */
    double momentum[3]; /* kg m/s: of the fluid, by shares as sph_step.mass, at the last step; this
                           rank */
    double
        mass_surplus; /* -: by what fraction of the fluid's mass too much flows, at the last step */
    double grown; /* m^dim: volume added by changes of level within this common step; this rank */
};

/* life.c, at the end of a step with the slopes of its last stage: moves the regions to s->t,
 * creates and removes particles, and sets the roles of all. s: the coarsest level. Collective. */
void refinement_adapt(struct sph *s);
/* The same at the start, when the finer levels have no particles: one level after the other is
 * created from the coarser one. settle may move the particles of a level but those at its edge
 * (ROLE_EDGE) before the next is created from them; NULL: all stay. */
void refinement_begin(struct sph *s, void (*settle)(struct sph *level));

/* Generations agree in number on average only, so that mass is created and lost as they take over
 * from each other. In a closed room all that flows compensates it, slowly; volumes as well, so that
 * densities stay. Collective. */
void refinement_restore_mass(struct sph *s);
/* The same of momentum along periods; see life.c. */
void refinement_restore_momentum(struct sph *s);
/* Takes the present mass of the fluid for that of the start. Collective. */
void refinement_remember(struct sph *s);
/* To be called before local particle i of a level is removed. */
void refinement_removed(struct sph *s, int i);

/* With local steps: refinement_adapt for the levels finer than `outside', which are at its time;
 * regions follow what these levels show. Particles of `outside' change roles as they enter or leave
 * the next region, but none of them is added or removed. s: the coarsest. Collective. */
void refinement_adapt_finer(struct sph *s, struct sph *outside);

/* Adds a child of particle i of s to `to' (s, or its finer level), displaced by d, m: 1/2^D of its
 * mass, its fields extrapolated by their slopes, rho by 5 % at most. Returns the child's index. */
int refinement_child(const struct sph *s, struct sph *to, int i, const double *d);
/* For sph.places. */
extern const struct level_places refinement_places;

/* look.c, before the adaption: computes what regions follow and, when they are due, the criteria,
 * from the packed records and slopes of the last stage. Collective. */
void refinement_look(struct sph *s);
/* What regions follow alone, from `outside' and finer levels. */
void refinement_follow(struct sph *s, struct sph *outside);
/* cover.c, after the regions have moved: warns of bodies that have left a region which held
 * them. */
void refinement_watch_bodies(struct sph *s);
/* After the rates of a stage: guards give nothing back for fluxes between them and what flows, so
 * that mass would be lost; in a closed room it is distributed over what flows, with its momentum.
 * Collective. */
void refinement_keep_mass(struct sph *s);
/* The same with local steps, at the end of the common step: `gained', kg, on this rank.
 * Collective. */
void refinement_spread_mass(struct sph *s, double gained);

/* life.c: ", level n" if the scene is refined, "" otherwise; valid until the next call. */
const char *sph_level_name(const struct sph *s);

#endif
