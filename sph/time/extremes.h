/* extremes.h - extremes over the particles of each level, then over ranks by one reduction: what
 * the next step, its skin and the watch depend on.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_EXTREMES_H
#define SPH_EXTREMES_H

#include "../refinement/sph_refinement.h"
#include "../sph.h"

enum { LEVELS = APR_LEVELS_MAX + 1 };

/* Minima are kept negated. */
enum {
    MOST_SIGNAL, /* c + |u - u0| */
    MOST_C,
    MOST_SHIFT,    /* |u - u0| */
    MOST_STRAY,    /* |u0 - drift| */
    MOST_RELATIVE, /* |u - drift| */
    MOST_U0,       /* [3] */
    LEAST_U0 = MOST_U0 + 3,
    MOST_SPEED = LEAST_U0 + 3,
    MOST_RHO,
    LEAST_RHO,
    MOST_FAULT, /* above 1: the state cannot be trusted */
    MOST_LOST,
    EXTREMES
};

/* most: one record per level, minima negated so that all are maxima. extremes_clear sets all to
 * -1e300; extremes_raise replaces *most by v if v is larger. */
void extremes_clear(double most[LEVELS][EXTREMES]);
void extremes_raise(double *most, double v);
/* Velocities of displacement of one level, from prim and slope, into its record. Guards count for
 * u0 alone, since they are moved with the flow but do not bound the step. */
void extremes_of_lines(struct sph *s, double *most);
/* Speeds, densities and faults (sph_fault_of) of one level, from y. */
void extremes_of_state(struct sph *s, double *most);
/* most[0] becomes the extremes over all levels and ranks, and all levels of s take over s->step
 * from it, each with its own signal. s: the coarsest. Collective. */
void extremes_reduce(struct sph *s, double most[LEVELS][EXTREMES]);
/* Reduces the record of one level over all ranks; that level takes over its signal and stray.
 * Collective. */
void extremes_reduce_level(struct sph *s, double *most);

#endif
