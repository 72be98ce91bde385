/* near.h - the points of a cloud that lie within R of a position, found by cells in the order of
 * their global number. Shared by all mappings.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>

#include "map.h"

/* The points within R of one position, as ascending indices j[n]; also work memory. */
struct reach {
    int n, nrun;
    int *j, *room;
    int run[28]; /* starts of ascending runs, one per cell */
};

/* The cells, of edge R at least, over the box of the targets and R around it. */
struct near {
    int dim, n[3];
    double R, lo[3], edge;
    const struct map_cloud *cloud; /* sorted; borrowed */
    long *start;                   /* [ncells + 1] */
    int *member; /* [n] indices into the sorted cloud, by cell; ascending within a cell */
    struct reach reach;
};

/* Sorts the cloud by gid; points of equal gid (images of one point) by position, so that the order
 * in which they came does not matter. */
void near_sort(struct map_cloud *c, int dim, int ncomp);
/* The cloud must be sorted and is borrowed as long as the cells are in use. x[n][dim]: all
 * positions that will be asked for, one at least. Owned by the caller (FREE). */
struct near *near_create(int dim, double R, const struct map_cloud *c, long n, const double *x);
/* The points within g->R of x; valid until the next call. */
const struct reach *near_gather(struct near *g, const double *x);

/* Sets v[ncomp] at x from the points r in reach; false: nothing is there, and v is 0. */
typedef bool near_one(int dim, double R, int ncomp, const struct reach *r,
                      const struct map_cloud *c, const double *x, double *v);
/* A mapping (map.h) of `one' after the other. */
void near_map(near_one *one, int dim, double R, int ncomp, struct map_cloud *from, long ntarget,
              const double *x, double *v, unsigned char *mask);

/* In map_nearest.c: which k < r->n is nearest to x; of equally near ones the first. */
int reach_nearest(int dim, const struct reach *r, const struct map_cloud *c, const double *x);
/* In map_shepard.c: the weights w[r->n] of the points in r, whose sum is 1 to rounding; false: all
 * are 0. */
bool map_weights(int dim, double R, bool mls, const struct reach *r, const struct map_cloud *c,
                 const double *x, double *w);
