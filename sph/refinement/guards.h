/* guards.h - particles whose fields are those of others: at the start of each stage a guard takes
 * pressure and velocity from the particles that flow within the support of the finer level of the
 * place, by Shepard's sums over both levels [5.23-5.24]. Its mass stays, its volume follows.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_GUARDS_H
#define SPH_GUARDS_H

#include "../sph.h"

/* A guard that is to be born at the end of the step. */
struct newborn {
    double t;                       /* s: when it would be at x */
    double x[3], u[3], volume, rho; /* m, m/s, m^dim, kg/m^3 */
    double slope[16];
};

/* The guards of one level and whom they take from: of each two rows of numbers, of the coarser
 * source and of the finer one, padded with the dummies of these levels. */
struct guards {
    int n, capacity;
    int nfiner, nshallow;  /* who come first: guards of this level outside of where it flows;
                              these and those that are not deep */
    int *who;              /* [n] locals */
    unsigned char *source; /* [n] the finer of their sources */
    bool *near;            /* [n] a source is near the free surface */
    int64_t (*first)[2];   /* [n] of its rows in j */
    int (*count)[2];       /* [n] */
    int j_capacity;
    int *j;
    int ghost_capacity;
    unsigned short *ghost; /* [nhalo] roles of the ghosts */
    int nprior;            /* locals that `prior' is of; 0: slopes are those of the last stage */
    double *prior; /* [nprior][nslope] slopes that guards were given before an output; what a
                      restart goes on from */
    bool fresh;    /* deep ones have not been given the fields of this step yet */
    int nnewborn, newborn_capacity;
    struct newborn *newborn; /* [nnewborn] of this level, at the end of the step; counts.h */
    bool mean;               /* fields by Shepard's mean [5.23-5.24] alone, for comparison */
    bool own_rates;          /* with local steps: fields of a guard go on by its own rates */
};

struct guards *guards_create(const struct run *r);
void guards_free(struct guards **g);
/* Once a step, after the lists of pairs of all levels. s: the coarsest. */
void guards_list(struct sph *s);
/* Each stage, before the first pass: state and lines of the guards of all levels. Collective. */
void guards_update(struct sph *s);
/* Lines, or slopes, of one level to its ghosts: of other ranks, periodic, mirrored. Collective. */
void guards_share(struct sph *s, bool slopes);
/* Of the guards of one level outside of where it flows alone, in its own steps; lines of
 * the coarser level and its ghosts must be of the time of the stage. Collective. */
void guards_update_edge(struct sph *s);
/* Before slopes are made for output: keeps those that the guards have been given. Should particles
 * be sorted anew before the next step, these come back: an output leaves no trace. All levels. */
void guards_remember(struct sph *s);
void guards_come_back(struct sph *s);
void guards_forget(struct sph *s);
/* Of one level, after the first pass: those at the edge are moved with the flow alone. */
void guards_hold_edge(struct sph *s);
/* Of one level, after the rates: guards move; with own_rates u and rho of those whose sums are
 * whole go on by these. */
void guards_rates(struct sph *s);

#endif
