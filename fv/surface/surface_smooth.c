/* surface_smooth.c - velocity without short waves beside the surface, where index lines meet it at
 * a slant or blocks overlap: u -= C'C u/(4^m dim) along each axis, C the difference of order m (0
 * where it leaves the cells), m = 3 for blocks that overlap, 2 where lines slant. Cells along such
 * a surface are no neighbours; waves of two to six of them, whose normal velocity the surface
 * hardly sees, grow by way of the extension. Waves of n cells along an axis lose (pi/n)^2m/dim a
 * pass. Half of it where no block slants: viscous waves have their shear just there.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"
#include "mesh_view.h"

#include <math.h>

enum {
    SMOOTH = 2, /* layers of air in sixth differences: further ones have kinks that feed waves */
    DEPTH = 4,  /* cells of water below the surface that are smoothed */
    PASSES = 4  /* a step, where lines slant */
};

/* Across the lower face of cell i (m = 3), or about cell i (2). */
static double difference(const struct fv *s, int m, const double *q, int64_t i, int64_t d)
{
    const unsigned char *out = s->surface->mesh->out, *layer = s->surface->layer;
    const int last = m == 2 ? LAYERS : SMOOTH;
    int64_t at = i - (m - 1) * d;
    for (int k = 0; k <= m; k++, at += d)
        if (out[at] || layer[at] > last)
            return 0.0;
    return m == 3 ? q[i + d] - q[i - 2 * d] - 3.0 * (q[i] - q[i - d])
                  : q[i + d] - 2.0 * q[i] + q[i - d];
}

static void smooth_part(const struct fv *s, const struct part *p, int m, double *q)
{
    static const int none[3] = {0, 0, 0};
    double *const sum = s->surface->rate, *const C = s->surface->kept;
    const double near = DEPTH * s->surface->largest, share = s->surface->mesh->slanting ? 1.0 : 0.5,
                 part = (m == 3 ? share / 64.0 : 1.0 / 16.0) / s->dim;
    for (int a = 0; a < s->dim; a++) {
        const int64_t d = p->stride[a];
        int down[3] = {0, 0, 0}, up[3] = {0, 0, 0};
        down[a] = 1;
        up[a] = m - 1;
        PART_ROWS (p, down, up, c, n)
            for (int64_t i = c; i < c + n; i++)
                C[i] = difference(s, m, q, i, d);
        PART_ROWS (p, none, none, c, n)
            for (int64_t i = c; i < c + n; i++)
                sum[i] =
                    (a ? sum[i] : 0.0) + (m == 3 ? C[i - d] - C[i + 2 * d] - 3.0 * (C[i] - C[i + d])
                                                 : C[i - d] - 2.0 * C[i] + C[i + d]);
    }
    PART_ROWS (p, none, none, c, n)
        for (int64_t i = c; i < c + n; i++)
            if (s->free[i] > 0.0 && s->surface->phi[i] > -near)
                q[i] -= part * sum[i];
}

void surface_smooth(struct fv *s)
{
    for (int q = 0; q < s->nparts && s->m; q++) {
        const bool leans = s->surface->mesh->leans[q];
        for (int a = 0; a < s->dim && s->surface->mesh->slants[q]; a++)
            for (int k = 0; k < (leans ? PASSES : 1); k++)
                smooth_part(s, s->part + q, leans ? 2 : 3, s->u[a]);
    }
}
