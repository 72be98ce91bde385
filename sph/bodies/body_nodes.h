/* body_nodes.h - points of a body's surface with the kernel averages of the particles around them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_NODES_H
#define SPH_BODY_NODES_H

#include "../walls/walls.h"

/* What particles say at a point of the surface. */
struct said {
    double W, P, shear[3];
};
enum { SAID = sizeof(struct said) / sizeof(double) };

/* Points of a body's surface, dx/2 of the finest level apart or closer. */
struct average_node {
    double x[3], n[3], u[3], du[3], area; /* area: 2D length */
    bool no_slip;
    struct said said;
};

struct nodes {
    int n, capacity;
    struct average_node *node; /* owned by whom asked for them: mem_free */
};

struct nodes body_nodes_lay(const struct sph *s, int body);
/* Fills said of all nodes from the particles of all levels and ranks. Collective. */
void body_nodes_ask(const struct sph *s, struct nodes *nodes);

#endif
