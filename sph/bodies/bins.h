/* bins.h - points sorted into boxes of one width, to find those near a position.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BINS_H
#define SPH_BINS_H

#include <stddef.h>

/* The boxes; start and who are owned. */
struct body_bins {
    int dim, n[3];    /* boxes along each axis */
    double lo[3];     /* m: corner of the first */
    double width;     /* m: edge of a box */
    int *start, *who; /* [boxes + 1]; [places] numbers of places, box by box */
};

/* A run of `who': first .. end - 1. */
struct bins_run {
    int first, end;
};
enum { BINS_RUNS = 9 };

/* Sorts n points, the first at x, each `stride' doubles after the one before, into boxes at least
 * `reach' wide, m (wider where boxes would outnumber the points by far). x is not kept. */
struct body_bins bins_create(int dim, int n, const double *x, size_t stride, double reach);
void bins_free(struct body_bins *b);
/* Sets run to the runs of all points that may lie within reach of x, and of others; returns how
 * many runs, at most BINS_RUNS. */
int bins_near(const struct body_bins *b, const double *x, struct bins_run run[BINS_RUNS]);

#endif
