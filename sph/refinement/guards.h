/* guards.h - particles whose fields are those of others: at the start of each stage a guard takes
 * pressure and velocity from the particles that flow within the support of the finer level of the
 * place, by Shepard's sums over both levels [5.23-5.24]. Its mass stays, its volume follows.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_GUARDS_H
#define SPH_GUARDS_H

#include "../sph.h"

/* The guards of one level and whom they take from: of each two rows of numbers, of the coarser
 * source and of the finer one, padded with the dummies of these levels. */
struct guards {
    int n, nshallow, capacity; /* guards; those that are not deep, which come first */
    int *who;                  /* [n] locals */
    unsigned char *source;     /* [n] the finer of their sources */
    int64_t (*first)[2];       /* [n] of its rows in j */
    int (*count)[2];           /* [n] */
    int j_capacity;
    int *j;
    int ghost_capacity;
    unsigned char *ghost; /* [nhalo] roles of the ghosts */
    int nprior;           /* locals that `prior' is of; 0: slopes are those of the last stage */
    double *prior;        /* [nprior][nslope] slopes that guards were given before an output; what a
                             restart goes on from */
    bool fresh;           /* deep ones have not been given the fields of this step yet */
};

struct guards *guards_create(void);
void guards_free(struct guards **g);
/* Once a step, after the lists of pairs of all levels. s: the coarsest. */
void guards_list(struct sph *s);
/* Each stage, before the first pass: state and lines of the guards of all levels. Collective. */
void guards_update(struct sph *s);
/* Before slopes are made for output: keeps those that the guards have been given. Should particles
 * be sorted anew before the next step, these come back: an output leaves no trace. All levels. */
void guards_remember(struct sph *s);
void guards_come_back(struct sph *s);
void guards_forget(struct sph *s);
/* Of one level, after the first pass: those at the edge are moved with the flow alone. */
void guards_hold_edge(struct sph *s);
/* Of one level, after the rates: guards move, no more. */
void guards_rates(struct sph *s);

#endif
