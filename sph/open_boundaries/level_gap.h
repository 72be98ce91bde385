/* level_gap.h - the difference between the level of the particles and that of the outer solution,
 * along each open side that a free surface crosses. Velocity and pressure tell neither program the
 * other's level: a step between them would decay only through the blending. A small outflow in
 * proportion to it, after Flather's condition, closes it without adding energy.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_LEVEL_GAP_H
#define SPH_LEVEL_GAP_H

#include "../../common/run/run.h"
#include "../sph.h"

/* Columns that the differences have in the series. */

/* The measured differences and the correction. */
struct level_gap {
    double *profile;   /* colour.h */
    bool kept;         /* the level outside is to be kept, whatever the start was */
    double at_rest[6]; /* m: else the difference at the start, which counts as none */
    double gap[6];     /* m: present difference beyond that, by side */
    double lasting[6]; /* m/s: part of the outflow that a lasting difference has called for */
    bool started;      /* at_rest is known */
    double mean;       /* m: mean |gap| over some coupling steps, of the worst side; it is judged */
    struct watch watched;
    int probes; /* places that were compared, last time */
};

/* kept: the level outside holds, not that of the start. Owned by the caller (FREE). */
struct level_gap *level_gap_create(const struct sph *s, bool kept);
/* Compares the levels at s->t, dt, s, after the last time, and sets the zones' outflow.
 * Collective. */
void level_gap_look(struct sph *s, double dt);
/* Adds its columns to the series. Collective. */
void level_gap_row(struct sph *s, struct figures *to);
/* Once a coupling step: fills d where the levels differ too much. */
void level_gap_judge(struct sph *s, struct diagnosis *d);
void level_gap_summary(const struct sph *s, struct summary *to);
/* Restart files, written or read; false: the file has none that fit. */
bool level_gap_restart(struct sph *s, struct h5 *f);

#endif
