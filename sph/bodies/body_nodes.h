/* body_nodes.h - points of a body's surface with kernel averages of the particles around them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_NODES_H
#define SPH_BODY_NODES_H

#include "../walls/sph_walls.h"

/* Sums over the particles around a point: W, pressure, shear stress, each weighted by w W. */
struct said {
    double W, P, shear[3];
};
enum { SAID = sizeof(struct said) / sizeof(double) };
/* Least W that sums are divided by: a wet plane has 1/2; of few particles the sum is theirs. */
#define AVERAGE_WET 0.4

/* A point of the surface, dx/2 of the finest level apart from the next or closer: position, m,
 * normal out of the fluid, velocity, m/s, acceleration, m/s^2, and the area that it stands for, m^2
 * (2D: m). */
struct average_node {
    double x[3], n[3], u[3], du[3], area; /* area: 2D length */
    bool no_slip;
    bool around;                    /* particles behind the plane of the surface count, too, */
    const struct wall_joint *joint; /* but for those that it hides; NULL: it hides none; borrowed */
    struct said said;
};

/* The points of one body. */
struct nodes {
    int n;
    struct average_node *node; /* owned by whom asked for them: mem_free */
};

/* Lays out the points of a body as it is now; node is owned by the caller (mem_free). */
struct nodes body_nodes_lay(const struct sph *s, int body);
/* Fills `said' of all points from the particles of all levels and ranks. Collective. */
void body_nodes_ask(const struct sph *s, struct nodes *nodes);

#endif
