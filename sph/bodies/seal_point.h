/* seal_point.h - a point of a solid's surface that another solid is close to, see body_seal.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SEAL_POINT_H
#define SPH_SEAL_POINT_H

#include "body_nodes.h"

enum { SEAL_OTHERS = 4, SEAL_OPENINGS = 16 };

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
    int level;                  /* that flows there, whose R all that follows is measured with */
    bool dry;                   /* one of the others lies on it */
    double reached;             /* -: the largest share of an other */
    bool rim;                   /* of the points those where it hardly matters */
    int opening;                /* of the rim: its number; else -1 */
    double from[SEAL_OPENINGS]; /* -: share of the water that seeps from each */
    double far;                 /* -: 0 near the rim, 1 far from it */
    double lack;                /* -: the kernel's part that is not behind the body */
    double room;                /* -: of that, the part before both */
    double part;                /* -: of the room and what is there, what is pressed here */
};

#endif
