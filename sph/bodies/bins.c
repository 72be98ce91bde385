/* bins.c - see bins.h. Counting sort of points into boxes of the width of the reach (wider where
 * there would be many more boxes than points): those near a place lie in the 3^dim boxes around it,
 * of which those along x follow each other in the list and make one run. O(n) to build.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bins.h"

#include "../../common/base/base.h"

/* Boxes of this width that hold everything up to hi; their number along each axis. */
static double count(const struct body_bins *b, const double *hi, int n[3])
{
    double all = 1.0;
    for (int a = 0; a < 3; a++) {
        const double m = a < b->dim ? floor((hi[a] - b->lo[a]) / b->width) + 1.0 : 1.0;
        all *= m;
        n[a] = m < 1e6 ? (int)m : 1000000;
    }
    return all;
}

/* The box of a point within the bounds; along x boxes have consecutive numbers, so that a run of
 * neighbours along x is one run of the list. */
static int box_of(const struct body_bins *b, const double *x)
{
    int at = 0;
    for (int a = b->dim - 1; a >= 0; a--)
        at = at * b->n[a] + (int)((x[a] - b->lo[a]) / b->width);
    return at;
}

struct body_bins bins_create(int dim, int n, const double *x, size_t stride, double reach)
{
    struct body_bins b = {.dim = dim, .width = reach, .n = {1, 1, 1}};
    double hi[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < n; k++)
        for (int a = 0; a < dim; a++) {
            const double v = x[(size_t)k * stride + (size_t)a];
            b.lo[a] = k == 0 ? v : fmin(b.lo[a], v);
            hi[a] = k == 0 ? v : fmax(hi[a], v);
        }
    while (count(&b, hi, b.n) > 8.0 * n + 1000.0)
        b.width *= 1.25;
    const int boxes = b.n[0] * b.n[1] * b.n[2];
    b.start = NEW(int, boxes + 1);
    b.who = NEW(int, n);
    for (int k = 0; k < n; k++)
        b.start[box_of(&b, x + (size_t)k * stride) + 1]++;
    for (int k = 0; k < boxes; k++)
        b.start[k + 1] += b.start[k];
    for (int k = n - 1; k >= 0; k--) { /* from behind: each box's end becomes its start */
        const int box = box_of(&b, x + (size_t)k * stride);
        b.who[--b.start[box + 1]] = k;
    }
    memmove(b.start, b.start + 1, (size_t)boxes * sizeof *b.start);
    b.start[boxes] = n;
    return b;
}

void bins_free(struct body_bins *b) { FREE(b->start, b->who); }

/* Outside of the bounds by more than a box, or no number: nobody is near. */
int bins_near(const struct body_bins *b, const double *x, struct bins_run run[BINS_RUNS])
{
    int lo[3] = {0, 0, 0}, hi[3] = {0, 0, 0}, n = 0;
    for (int a = 0; a < b->dim; a++) {
        const double at = floor((x[a] - b->lo[a]) / b->width);
        if (!(at >= -1.0 && at <= b->n[a]))
            return 0;
        lo[a] = at > 0.0 ? (int)at - 1 : 0;
        hi[a] = at < b->n[a] - 1.0 ? (int)at + 1 : b->n[a] - 1;
    }
    for (int k = lo[2]; k <= hi[2]; k++)
        for (int j = lo[1]; j <= hi[1]; j++) {
            const int row = (k * b->n[1] + j) * b->n[0];
            const struct bins_run r = {b->start[row + lo[0]], b->start[row + hi[0] + 1]};
            if (r.end > r.first)
                run[n++] = r;
        }
    return n;
}
