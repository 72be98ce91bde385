/* body_seal.h - what the faces of two solids owe each other that stand so close, or in so sharp a
 * wedge, that no particle gets between: see body_seal.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_SEAL_H
#define SPH_BODY_SEAL_H

#include "body_nodes.h"

enum { SEAL_OTHERS = 4 };

/* A solid behind whose faces the kernel of a point reaches. */
struct seal_other {
    int body;         /* -1: walls at rest */
    bool lies_on;     /* it, so that no water comes there */
    double share;     /* -: of the kernel */
    double weight[3]; /* m^2/s^2: wall_share_weight */
};

/* A point of a body's surface whose kernel reaches behind the faces of another solid. */
struct seal_point {
    struct average_node is;
    int body, nothers;
    struct seal_other other[SEAL_OTHERS];
    int level;      /* that flows there, whose R all that follows is measured with */
    bool dry;       /* one of the others lies on it */
    double reached; /* -: the largest share of an other */
    bool rim;       /* of the points those where it hardly matters */
    double far;     /* -: 0 near the rim, 1 far from it */
    double lack;    /* -: the kernel's part that is not behind the body */
    double room;    /* -: of that, the part before both */
    double part;    /* -: of the room and what is there, what is pressed here */
};

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
