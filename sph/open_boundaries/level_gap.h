/* level_gap.h - the level of the particles over that of the outer solution, along each open side
 * that a free surface crosses. Velocity and pressure tell neither program the other's level: a step
 * between them would die by what the blending lets through alone. A small outflow in proportion to
 * it, by Flather's condition, closes it and feeds nothing. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_LEVEL_GAP_H
#define SPH_LEVEL_GAP_H

#include "../../common/run/watch.h"
#include "../sph.h"

enum { LEVEL_COLUMNS = 8 };

struct level_gap {
    double *profile;   /* colour.h */
    double at_rest[6]; /* m: gap at the start, which is no step */
    double gap[6];     /* m: now, over that */
    double lasting[6]; /* m/s: part of it that a lasting gap has called for */
    bool started;      /* at_rest is known */
    double mean;       /* m: of |gap| over some coupling steps, the largest side: what is judged */
    struct watch watched;
    int probes; /* places that were compared, last time */
};

struct level_gap *level_gap_create(const struct sph *s);
void level_gap_free(struct level_gap **g);
/* Compares at s->t, dt after the last time: zones' `outflow' follows. Collective. */
void level_gap_look(struct sph *s, double dt);
/* Names and values of LEVEL_COLUMNS columns. Collective. */
extern const char *const level_gap_columns[LEVEL_COLUMNS];
void level_gap_row(struct sph *s, double *values);
/* Once a coupling step: fills d where the levels have parted. */
void level_gap_judge(struct sph *s, struct diagnosis *d);
void level_gap_summary(const struct sph *s, struct summary *to);
void level_gap_save(const struct sph *s, struct h5 *f);
bool level_gap_load(struct sph *s, struct h5 *f);

#endif
