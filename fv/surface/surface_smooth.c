/* surface_smooth.c - velocity without short waves beside the surface, where index lines meet it at
 * a slant or blocks overlap: u -= C'C u/(4^m dim) along each axis, C the difference of order m (0
 * where it leaves the cells), m = 3 for blocks that overlap, 2 where lines slant. Cells along such
 * a surface are no neighbours; waves of two to six of them, whose normal velocity the surface
 * hardly sees, grow by way of the extension. Waves of n cells along an axis lose (pi/n)^2m/dim a
 * pass. Half of it where no block slants: viscous waves have their shear just there. On even cells
 * and upright blocks fourth differences of the water alone, by half, in short steps by less: what
 * surface_line.c leaves of growth is of second order in the step; nothing in water that crosses
 * half a cell a step, which has other losses. SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include "../boundary/fv_boundary.h"
#include "level_ops.h"
#include "mesh_view.h"

enum {
    SMOOTH = 2, /* layers of air in sixth differences: further ones have kinks that feed waves */
    DEPTH = 4,  /* cells of water below the surface that are smoothed */
    PASSES = 4  /* a step, where lines slant */
};

/* Across the lower face of cell i (m = 3), or about cell i (2). */
static double difference(const struct fv *s, int m, const double *q, int64_t i, int64_t d)
{
    const unsigned char *layer = s->surface->layer;
    const int last = m == 3 ? SMOOTH : surface_any_inclined(s) ? LAYERS : 0;
    int64_t at = i - (m - 1) * d;
    for (int k = 0; k <= m; k++, at += d)
        if (surface_holds_none(s, at) || layer[at] > last)
            return 0.0;
    return m == 3 ? q[i + d] - q[i - 2 * d] - 3.0 * (q[i] - q[i - d])
                  : q[i + d] - 2.0 * q[i] + q[i - d];
}

/* C'C q at a cell along the step d. */
static double bent(const struct fv *s, int m, const double *q, int64_t i, int64_t d)
{
    const double low = difference(s, m, q, i - d, d), here = difference(s, m, q, i, d),
                 up = difference(s, m, q, i + d, d);
    return m == 3 ? low - difference(s, m, q, i + 2 * d, d) - 3.0 * (here - up)
                  : low - 2.0 * here + up;
}

/* Wet cells of FV's own within DEPTH of the surface. */
static bool is_smoothed(const struct fv *s, int64_t c)
{
    const struct surface *f = s->surface;
    if (!(f->phi[c] > -DEPTH * f->largest))
        return false;
    return f->layer[c] == 0 && forcing_is_free(s, c);
}

static void smooth_part(const struct fv *s, const struct part *p, int m, const double share[3],
                        double *q)
{
    double *const sum = s->surface->rate;
    const double part = 1.0 / (m == 3 ? 64.0 : 16.0) / s->dim;
    PART_NEAR (p, no_layers, no_layers, c, n)
        for (int64_t i = c; i < c + n; i++) {
            sum[i] = 0.0;
            for (int a = 0; a < s->dim && is_smoothed(s, i); a++)
                sum[i] += share[a] * bent(s, m, q, i, p->stride[a]);
        }
    PART_NEAR (p, no_layers, no_layers, c, n)
        for (int64_t i = c; i < c + n; i++)
            q[i] -= part * sum[i];
}

/* Cells that are flat along gravity know waves along axis a well that are short in cells. */
static double flatness(const struct fv *s, const struct part *p, int a)
{
    const double h = s->surface->ops->spacing_along(s, p, a), flat = s->surface->least / h;
    return fmin(1.0, flat * flat);
}

/* -: of what is smoothed along axis a, 0: nothing. */
static double share_of(const struct fv *s, const struct part *p, int a, double dt)
{
    const double calm = fmax(0.0, 1.0 - 2.0 * s->max.rate * dt);
    if (surface_inclined(s, p))
        return 1.0;
    if (grid_overlaps(&s->grid))
        return s->surface->any_inclined ? 1.0 : 0.5;
    return calm * flatness(s, p, a) * fmin(0.5, 2.0 * s->surface->g * dt * dt / s->surface->across);
}

/* One pass over the component q of a part's velocity; k: passes before it. */
static void smooth_pass(const struct fv *s, const struct part *p, double dt, int k, double *q)
{
    const bool inclined = surface_inclined(s, p), overlaps = grid_overlaps(&s->grid) && !inclined;
    double share[3], most = 0.0;
    for (int a = 0; a < s->dim; a++) {
        share[a] = share_of(s, p, a, dt);
        most = fmax(most, share[a]);
    }
    if (most > 0.0 && (k == 0 || inclined)) /* else the water is not calm */
        smooth_part(s, p, overlaps ? 3 : 2, share, q);
}

/* A pass sees two cells beyond a part's own, so that those of others are sent before each but the
 * first: else what comes out would depend on how cells are shared out among parts and ranks. */
void surface_smooth(struct fv *s, double dt)
{
    const int passes = surface_any_inclined(s) ? PASSES : 1;
    for (int a = 0; a < s->dim; a++)
        for (int k = 0; k < passes; k++) {
            if (k > 0)
                grid_halo(&s->grid, 1, &s->u[a]);
            for (int q = 0; q < s->grid.nparts; q++)
                smooth_pass(s, s->grid.part + q, dt, k, s->u[a]);
        }
}
