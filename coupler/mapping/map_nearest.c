/* map_nearest.c - the nearest source: see map.h. Sources come in the order of their gid, so that
 * `<' keeps the lowest of equally near ones.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <string.h>

#include "near.h"

void map_nearest(int dim, double R, int ncomp, struct map_cloud *from, long ntarget,
                 const double *x, double *v, unsigned char *mask)
{
    struct reach r = {0};
    if (ntarget == 0)
        return;
    near_sort(from, dim, ncomp);
    struct near g = near_create(dim, R, from, ntarget, x);
    for (long i = 0; i < ntarget; i++) {
        long best = -1;
        double least = INFINITY;
        near_gather(&g, x + i * dim, &r);
        for (int k = 0; k < r.n; k++) {
            double r2 = 0.0;
            for (int d = 0; d < dim; d++)
                r2 += pow(from->x[(long)r.j[k] * dim + d] - x[i * dim + d], 2);
            if (r2 < least) {
                least = r2;
                best = r.j[k];
            }
        }
        mask[i] = best >= 0;
        if (best >= 0)
            memcpy(v + i * ncomp, from->v + best * ncomp, (size_t)ncomp * sizeof *v);
        else
            memset(v + i * ncomp, 0, (size_t)ncomp * sizeof *v);
    }
    reach_free(&r);
    near_free(&g);
}
