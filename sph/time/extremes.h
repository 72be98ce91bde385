/* extremes.h - largest values over the particles of each level, then over ranks by one reduction:
 * what the next step, its skin and the watch depend on. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_EXTREMES_H
#define SPH_EXTREMES_H

#include "../refinement/apr_params.h"
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

/* most: rows by level; here of all levels, the others of the row of one. */
void extremes_clear(double most[LEVELS][EXTREMES]);
void extremes_raise(double *most, double v);
/* Velocities of displacement of one level, from prim and slope. The step is not bound by guards,
 * which are moved alone. */
void extremes_of_lines(struct sph *s, double *most);
/* Speeds, densities and faults of one level, from y. */
void extremes_of_state(struct sph *s, double *most);
/* most[0] gets the values over all levels and ranks, and all levels of s learn them. Collective. */
void extremes_reduce(struct sph *s, double most[LEVELS][EXTREMES]);
/* The row of one level, over all ranks; that level learns its signal and how fast its particles
 * part. Collective. */
void extremes_reduce_level(struct sph *s, double *most);

#endif
