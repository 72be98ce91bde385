/* body_seal.h - what the faces of two solids owe each other that stand so close, or in so sharp a
 * wedge, that no particle gets between: see body_seal.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_SEAL_H
#define SPH_BODY_SEAL_H

#include "seal_point.h"

/* The points of a body, measured where all bodies were `at' the time, m: three material points of
 * each; what they have in common with those that came `near' it goes by where these were. */
struct seal_rest {
    double at[BODIES_MAX][3][3];
    bool near[BODIES_MAX];
    int n;
    struct seal_point of[];
};

/* Marks what free bodies rest on since the start as sealed. */
void seals_mark(struct walls *w, int body);

/* Gives the asked points of a body the pressure of the water that seeps in between it and what it
 * is sealed with, where no particle comes; none where they lie on each other. Collective. */
void seal_nodes_fill(const struct sph *s, int body, struct nodes *nodes);

#endif
