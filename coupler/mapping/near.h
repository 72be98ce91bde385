/* near.h - the points of a cloud that lie within R of a position, found by cells in the order of
 * their global number. Shared by all mappings.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_NEAR_H
#define COUPLER_NEAR_H

#include <stdbool.h>

#include "map.h"

/* The cells, of edge R at least, over the box of the targets and R around it. */
struct near {
    int dim, n[3];
    double R, lo[3], edge;
    const struct map_cloud *cloud; /* sorted; borrowed until near_free */
    long *start;                   /* [ncells + 1] */
    int *member; /* [n] indices into the sorted cloud, by cell; ascending within a cell */
};

/* The points within R of one position, as ascending indices j[n]; also work memory. {0} is
 * empty. */
struct reach {
    int n, capacity, nrun;
    int *j, *room;
    int run[28]; /* starts of ascending runs, one per cell */
};

/* Sorts the cloud by gid; points of equal gid (images of one point) by position, so that the order
 * in which they came does not matter. */
void near_sort(struct map_cloud *c, int dim, int ncomp);
/* The cloud must be sorted and is borrowed until near_free. x[n][dim]: all positions that will be
 * asked for, one at least. */
struct near near_create(int dim, double R, const struct map_cloud *c, long n, const double *x);
/* Sets r to the points within g->R of x. */
void near_gather(const struct near *g, const double *x, struct reach *r);
void near_free(struct near *g);
void reach_free(struct reach *r);

/* In map_shepard.c: the weights w[r->n] of the points in r, whose sum is 1 to rounding; false: all
 * are 0. */
bool map_weights(int dim, double R, bool mls, const struct reach *r, const struct map_cloud *c,
                 const double *x, double *w);

#endif
