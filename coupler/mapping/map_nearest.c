/* map_nearest.c - the nearest source: see map.h. Sources come in the order of their gid, so that
 * `<' keeps the lowest of equally near ones.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <string.h>

#include "near.h"

/* Its place in the list; of an empty one 0. */
int reach_nearest(int dim, const struct reach *r, const struct map_cloud *c, const double *x)
{
    int best = 0;
    double least = INFINITY;
    for (int k = 0; k < r->n; k++) {
        double r2 = 0.0;
        for (int d = 0; d < dim; d++)
            r2 += pow(c->x[(long)r->j[k] * dim + d] - x[d], 2);
        if (r2 < least) {
            least = r2;
            best = k;
        }
    }
    return best;
}

static bool nearest_one(int dim, double R, int ncomp, const struct reach *r,
                        const struct map_cloud *c, const double *x, double *v)
{
    (void)R;
    if (r->n > 0)
        memcpy(v, c->v + (long)r->j[reach_nearest(dim, r, c, x)] * ncomp,
               (size_t)ncomp * sizeof *v);
    else
        memset(v, 0, (size_t)ncomp * sizeof *v);
    return r->n > 0;
}

void map_nearest(int dim, double R, int ncomp, struct map_cloud *from, long ntarget,
                 const double *x, double *v, unsigned char *mask)
{
    near_map(nearest_one, dim, R, ncomp, from, ntarget, x, v, mask);
}
