/* bins.h - places sorted into boxes of one width, for the question which are near a point.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BINS_H
#define SPH_BINS_H

#include <stddef.h>

struct body_bins {
    int dim, n[3];    /* boxes along each axis */
    double lo[3];     /* m: corner of the first */
    double width;     /* m: edge of a box */
    int *start, *who; /* [boxes + 1]; [places] numbers of places, box by box */
};

/* Runs of `who', as first and last + 1. */
struct bins_run {
    int first, end;
};
enum { BINS_RUNS = 9 };

/* n places, the first at x, each `stride' doubles after the one before; boxes at least `reach'
 * wide, wider where they would outnumber the places by far. */
struct body_bins bins_create(int dim, int n, const double *x, size_t stride, double reach);
void bins_free(struct body_bins *b);
/* Runs of all places that may lie within reach of x (and others); how many, at most BINS_RUNS. */
int bins_near(const struct body_bins *b, const double *x, struct bins_run run[BINS_RUNS]);

#endif
