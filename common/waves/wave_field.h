/* wave_field.h - a sea or a group that evolves nonlinearly (evolution.h) over a periodic line or
 * plane: of second order at first, eight periods of the peak before the run. Steps of a sixtieth of
 * the peak's period, which are its frames; those asked for out of turn are computed anew and have
 * the same bits. x along the direction of travel, y across it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_FIELD_H
#define COMMON_WAVE_FIELD_H

#include <stdbool.h>

#include "evolution.h"
#include "imposed_waves.h"
#include "swd.h"

/* States of earlier steps that are kept: a solver that repeats a step asks for no older one. */
enum { WAVE_FIELD_KEPT = 8 };

/* A field with what is needed to return to earlier steps. Every rank holds and evolves the same
 * field. */
struct wave_field {
    struct evolution *of;   /* owned */
    struct swd *file;       /* what its frames are read from; NULL: it evolves; owned */
    double *modes;          /* of a time of the file */
    struct wave_grid *fine; /* owned: that of the tables */
    int upper;              /* nodes of a column that move with the surface */
    double *raise;          /* [upper][layer nodes]: values at nodes from those of the layer */
    double *lower[2];       /* [cells][lower nodes]: u over |k| phi, w over |k| phi of a mode */
    const struct wave_component *components; /* borrowed: n of them, which it begins with at t0 */
    int n;
    double t0;                       /* s */
    bool begun;                      /* `start' has been computed */
    double *start;                   /* modes of eta + i phi_s before all steps */
    double *z, *padded, *work;       /* modes and fields of the columns */
    long kept[WAVE_FIELD_KEPT];      /* steps whose states are kept, to go back to; -1: none */
    double *states[WAVE_FIELD_KEPT]; /* modes of those states, [cells][2] each; owned */
    double energy;                   /* m^3/s^2: when all terms had grown; 0: not yet */
};

/* Of waves whose peak has that period, s, and length, m. Its components, *n by |k|, become the
 * caller's, but must outlive the field. */
struct wave_field *wave_field_create(const struct wave_spec *of, double period, double length,
                                     struct wave_component **components, int *n);
/* One whose frames are the times of the file of->file, which wave_file_probe found sound. */
struct wave_field *wave_field_of_file(const struct wave_spec *of, double length,
                                      struct wave_component **components, int *n);
/* An empty table that covers of->window; longest: length of the longest waves, m. */
struct wave_table wave_field_table(void *owner, const struct wave_field *f,
                                   const struct wave_spec *of, double longest);
/* Factors of the velocities that correct for the zone, [modes]; NULL: there is no zone. Owned by
 * the caller (mem_free). */
double _Complex *wave_field_filter(const struct wave_field *f, const struct wave_spec *of,
                                   const struct wave_component *components, int n);
/* Fills `to' with the velocities of a frame, which is 0 at t = 0. false: the waves break before
 * it. */
bool wave_field_frame(struct wave_field *f, long frame, const double _Complex *filter,
                      struct wave_table *to);
/* Continues from the modes [cells][2] of a step (restart). */
void wave_field_set(struct wave_field *f, long step, const double *modes, double energy);
/* Estimated computing time of one period of these waves on one rank, s. */
double wave_field_seconds(const struct wave_field *f, double period);

#endif
