/* shore.c - where the water ends on a beach, in 2D with gravity along -y. Columns at distances dx,
 * each with a hat function of half width 2 dx, sum the volume V of the water and its first moment
 * in y. From the gauge's x the first column to either side with less than half a layer (V < dx/2 x
 * 2 dx) ends the water; the ground at the last wet one is at mean height less half the depth, V/(2
 * dx). Drops that fly ahead of the water, with a gap behind them, do not count.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "shore.h"

static const double half = 2.0;  /* dx: half width of a column's hat function */
static const double least = 0.5; /* dx: depth of the thinnest water */

/* Adds the volumes of one level, where levels meet by shares, and their moments in y, to columns of
 * distance dx. sums[2 k] and [2 k + 1]: volume and moment of column k at lo + k dx. */
static void fill_columns(const struct sph *s, double lo, double dx, int n, double *sums)
{
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i), at = (q[0] - lo) / dx,
                     w = q[at_volume(s->dim)] * particles_share(s, q);
        const int first = (int)fmax(ceil(at - half), 0.0);
        for (int k = first; k < n && k < at + half; k++) {
            const double part = w * (1.0 - fabs(at - k) / half);
            sums[2 * k] += part;
            sums[2 * k + 1] += part * q[1];
        }
    }
}

/* Height of the ground at the last wet column from `start' on, NAN: the water goes on. way: +1 or
 * -1. NAN too where the first column is dry. */
static double edge(int n, const double *sums, double dx, int start, int way)
{
    int k = start;
    while (k >= 0 && k < n && sums[2 * k] >= least * half * dx * dx)
        k += way;
    if (k == start || k < 0 || k >= n)
        return NAN;
    const double *last = sums + 2 * (k - way);
    return last[1] / last[0] - 0.5 * last[0] / (half * dx);
}

/* One reduction over all columns; the higher edge counts. */
double shore_height(struct sph *s, double x)
{
    const int n = (int)round((s->hi[0] - s->lo[0]) / s->dx) + 1;
    const int start = (int)round((x - s->lo[0]) / s->dx);
    double *sums = NEW(double, 2 * n);
    for (const struct sph *q = s; q; q = q->finer)
        fill_columns(q, s->lo[0], s->dx, n, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2 * n, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double low = edge(n, sums, s->dx, start, -1), high = edge(n, sums, s->dx, start, 1);
    mem_free(sums);
    return fmax(low, high); /* the number, if one of them is none */
}
