/* near.h - who is within R of a place: points of a cloud in cells, found in the order of their
 * global number. What all mappings share. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_NEAR_H
#define COUPLER_NEAR_H

#include <stdbool.h>

#include "map.h"

/* Points in cells; within a cell in the order of gid. */
struct near {
    int dim, n[3];
    double R, lo[3], edge;
    const struct map_cloud *cloud; /* sorted; borrowed until near_free */
    long *start;                   /* [ncells + 1] */
    int *member;                   /* points by cell: places in the sorted cloud */
};

/* Those in reach of one place, in ascending order. Empty: {0}. */
struct reach {
    int n, capacity, nrun;
    int *j, *room;
    int run[28]; /* starts of ascending runs, one per cell */
};

/* By gid; equal numbers (images of one point) by place, whatever order they came in. */
void near_sort(struct map_cloud *c, int dim, int ncomp);
/* The cloud is sorted; x[n][dim]: the places that will be asked for, one at least. */
struct near near_create(int dim, double R, const struct map_cloud *c, long n, const double *x);
void near_gather(const struct near *g, const double *x, struct reach *r);
void near_free(struct near *g);
void reach_free(struct reach *r);

/* map_shepard.c: w[r->n], of sum 1 to rounding; false: all are 0. */
bool map_weights(int dim, double R, bool mls, const struct reach *r, const struct map_cloud *c,
                 const double *x, double *w);

#endif
