/* guards.h - guards: particles whose fields are those of others. At the start of each stage a guard
 * takes pressure and velocity from the particles that flow within the support of the finer level of
 * the place, by Shepard's sums over both levels (Chiron 2017, [5.23-5.24]). Its mass stays, its
 * volume follows the density.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_GUARDS_H
#define SPH_GUARDS_H

#include "../sph.h"

/* A guard that is to be created at the end of the step. */
struct created {
    double t;                       /* s: when it would be at x */
    double x[3], u[3], volume, rho; /* m, m/s, m^dim, kg/m^3 */
    double slope[16];
};

/* The guards of one level and the particles that they take from: for each guard two rows of numbers
 * in j, of its coarser and of its finer source level, padded with the dummies of these levels. */
struct guards {
    int n;
    /* In who come first the guards outside of where this level flows; nshallow counts these and
     * those that are not deep. */
    int nfiner, nshallow;
    int *who;              /* [n] locals */
    unsigned char *source; /* [n] the finer of their sources */
    bool *near;            /* [n] whether a source is near the free surface */
    int64_t (*first)[2];   /* [n] of its rows in j */
    int (*count)[2];       /* [n] */
    int *j;
    unsigned short *ghost; /* [nhalo] roles of the ghosts */
    int nprior;            /* locals that `prior' holds; 0: slopes are those of the last stage */
    /* [nprior][nslope] slopes that guards were given before an output; a restart continues from
     * them. */
    double *prior;
    bool fresh; /* deep guards have not yet been given the fields of this step */
    int ncreated;
    struct created *created; /* [ncreated] of this level, at the end of the step; counts.h */
    bool mean;               /* fields by Shepard's mean [5.23-5.24] alone, for comparison */
    bool own_rates;          /* with local steps: a guard's fields continue by its own rates */
};

/* Role of a local or a ghost; after guards_list. */
static inline int guards_role(const struct sph *s, int i)
{
    return i < s->p.n ? s->p.role[i] : s->guards->ghost[i - s->p.n];
}
/* Whether particle i is a guard because a coarser level than its own flows there. */
static inline bool guards_is_outside(const struct sph *s, int i)
{
    return particles_is_guard(&s->p, i) && (s->p.role[i] >> ROLE_SOURCE & 15) == s->level;
}

/* The empty list of one level; freed by FREE. */
struct guards *guards_create(const struct run *r);
/* Lists the guards of all levels with their sources, once a step after the lists of pairs. s: the
 * coarsest. */
void guards_list(struct sph *s);
/* Each stage, before the first pass, when records are packed: sets state and records of the guards
 * of all levels. Collective. */
void guards_update(struct sph *s);
/* The same at the end of a step, for those within half a coarser spacing of where their level
 * flows: if they begin to flow now they must have the fields of its end. Collective. */
void guards_wake(struct sph *s);
/* Sends prim, or slopes, of one level to its ghosts: of other ranks, periodic, mirrored.
 * Collective. */
void guards_share(struct sph *s, bool slopes);
/* With local steps: sets the guards of one level outside of where it flows; packed records of the
 * coarser level and its ghosts must be of the time of the stage. Collective. */
void guards_update_edge(struct sph *s);
/* guards_remember keeps the slopes that the guards have been given before slopes are made for
 * output. guards_come_back restores them if particles are sorted anew before the next step, so that
 * an output leaves no trace; guards_forget drops them. All levels. */
void guards_remember(struct sph *s);
void guards_come_back(struct sph *s);
void guards_forget(struct sph *s);
/* For one level, after the first pass: guards at the edge are moved with the flow alone, without
 * shift. */
void guards_hold_edge(struct sph *s);
/* For one level, when the slopes of a list's first stage are whole: leaves pairs that only guards
 * have, whose rates guards_rates overwrites and no wall reads, out of the passes for rates. */
void guards_spare(struct sph *s);
/* For one level, after the rates: guards move; with own_rates, u and rho of those with a full
 * support continue by their rates. */
void guards_rates(struct sph *s);

#endif
