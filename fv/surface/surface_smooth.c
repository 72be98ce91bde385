/* surface_smooth.c - velocity without waves of two cells beside the surface, where index lines meet
 * it at a slant or blocks overlap: u -= C'C u/(64 dim) along each axis, C the third difference (0
 * where it leaves the cells). Cells along such a surface are no neighbours; waves of two of them
 * are seen neither by the fluxes nor by the pressure, and grow slowly by way of the extension.
 * Waves of n cells along an axis lose (pi/n)^6/dim a step. SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"
#include "mesh_view.h"

#include <math.h>

enum { DEPTH = 4 }; /* cells of water below the surface that are smoothed */

static double third(const struct fv *s, const double *q, int64_t i, int64_t d)
{
    const unsigned char *out = s->surface->mesh->out, *layer = s->surface->layer;
    for (int64_t at = i - 2 * d, m = 0; m < 4; m++, at += d)
        if (out[at] || (layer[at] > LAYERS))
            return 0.0;
    return q[i + d] - q[i - 2 * d] - 3.0 * (q[i] - q[i - d]);
}

static void smooth_part(const struct fv *s, const struct part *p, double *q)
{
    static const int none[3] = {0, 0, 0};
    double *const sum = s->surface->rate, *const C = s->surface->kept;
    const double near = DEPTH * s->surface->largest;
    for (int a = 0; a < s->dim; a++) {
        const int64_t d = p->stride[a];
        int down[3] = {0, 0, 0}, up[3] = {0, 0, 0};
        down[a] = 1;
        up[a] = 2;
        PART_ROWS (p, down, up, c, n)
            for (int64_t i = c; i < c + n; i++)
                C[i] = third(s, q, i, d);
        PART_ROWS (p, none, none, c, n)
            for (int64_t i = c; i < c + n; i++)
                sum[i] = (a ? sum[i] : 0.0) + C[i - d] - C[i + 2 * d] - 3.0 * (C[i] - C[i + d]);
    }
    PART_ROWS (p, none, none, c, n)
        for (int64_t i = c; i < c + n; i++)
            if (s->free[i] > 0.0 && s->surface->phi[i] > -near)
                q[i] -= sum[i] / (64.0 * s->dim);
}

void surface_smooth(struct fv *s)
{
    for (int q = 0; q < s->nparts && s->m; q++)
        for (int a = 0; a < s->dim && s->surface->mesh->slants[q]; a++)
            smooth_part(s, s->part + q, s->u[a]);
}
