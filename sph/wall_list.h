/* wall_list.h - particles near walls in 2D, the segments near each, and what each segment has of
 * the particle's kernel. The list is made once a step; its integrals once a stage, for all who ask.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_LIST_H
#define SPH_WALL_LIST_H

#include "walls.h"

/* One segment as one particle sees it. */
struct wall_touch {
    int segment;
    double gamma;        /* -: its part of the Shepard factor less one */
    double W;            /* 1/m: int W ds; 0: beyond the support */
    double e[2];         /* m: from the particle to the centre of that weight */
    double near;         /* -: min(1, (dx/2)^2/e^2) */
    double from, height; /* m: of the segment's start from the foot of the particle, of the particle
                            over the segment's line */
};

struct wall_list {
    int n, capacity;
    int *who, *first; /* [n], [n+1] */
    int touches_capacity;
    struct wall_touch *touch; /* [first[n]] */
    double *gamma;            /* [n] Shepard factor */
    bool measured;            /* touch and gamma are of the present places */
    int boxes_capacity;
    double (*boxes)[4]; /* around each WALL_GROUP segments: low x, y, high x, y */
};

void wall_list_free(struct wall_list *l);
/* Particles nearer than R, the skin and the way of a step to a segment. */
void wall_list_build(const struct sph *s, struct wall_list *l);
/* touch and gamma at the present places of particles and walls. */
void wall_list_measure(const struct sph *s, struct wall_list *l);
/* Lists locals whose state is behind the nearest of their segments; returns their number. */
int wall_list_behind(const struct sph *s, const struct wall_list *l, int *who);

#endif
