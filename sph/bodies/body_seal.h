/* body_seal.h - water where solids stand so close, or in so sharp a wedge, that no particle gets
 * there: it is wet all the same, and its pressure is that of the water around.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_SEAL_H
#define SPH_BODY_SEAL_H

#include "body_nodes.h"

/* A point of a body's surface close before what it rests on, or stands beside. */
struct seal_point {
    const struct average_node *is;
    int other;     /* body, -1: walls at rest */
    double full;   /* -: said.W where the water is whole */
    double sealed; /* -: part of the pressure that no particle gives; 0: of the wet rim */
};

/* Share of the water at a point that particles are there for, 0 to 1. */
double seal_wetness(const struct seal_point *p);
/* Presses the points of a body that are sealed with what the others say, and what is before them
 * with the opposite. On rank 0. */
void seal_points_press(struct sph *s, int body, const struct seal_point *of, int n);

/* body_wedge.c: what body_seals_add has to add in a stage for bodies that stay where they are.
 * Needs prim. Collective. */
void body_wedges_add(struct sph *s);

#endif
