/* fixed_layers.h - where fixed ghosts stand behind polylines, and what volume each stands for.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_FIXED_LAYERS_H
#define SPH_FIXED_LAYERS_H

#include "walls.h"

/* A ghost as it lies at t = 0. */
struct fixed_node {
    double x[2], foot[2]; /* m: itself, the nearest point of the wall */
    double w;             /* m^2 */
    int segment;          /* that the foot lies on */
};

struct fixed_layers {
    int n;
    struct fixed_node *of; /* [n], owned */
};

/* Layers behind all segments as deep as R. */
void fixed_layers_lay(const struct sph *s, struct fixed_layers *to);
/* Where a place of the start, moved with a segment, is now. */
void fixed_carry(const struct walls *w, int segment, const double *from, double *to);

#endif
