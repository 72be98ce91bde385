/* wave_outside.c - see wave_outside.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_outside.h"

#include <math.h>
#include <string.h>

#include "../../common/scene/exact.h"

static const double step = 1e-4; /* of differences, over the depth */

bool wave_outside_wanted(const struct run *r, const struct sph_params *prm)
{
    return prm->outer == OUTER_EXACT && prm->surface == SURFACE_YES &&
           scene_has_steady_wave(&r->scene);
}

/* The wave varies along x and y alone. */
static void add_gradients(const struct exact *e, double t, const double *x, double *gu, double *gp)
{
    const double h = step * e->height;
    memset(gu, 0, 3 * (size_t)e->dim * sizeof *gu);
    memset(gp, 0, 3 * sizeof *gp);
    for (int b = 0; b < 2; b++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double y[3] = {x[0], x[1], x[2]}, v[3], q;
            y[b] += sign * h;
            exact_point(e, y, t, v, &q, NULL);
            for (int a = 0; a < e->dim; a++)
                gu[3 * a + b] += sign * v[a] / (2.0 * h);
            gp[b] += sign * q / (2.0 * h);
        }
}

void wave_outside_eval(void *ctx, double t, int n, const double *x, double *u, double *p,
                       double *gu, double *gp)
{
    const struct exact *e = ctx;
    for (int i = 0; i < n; i++) {
        double v[3];
        exact_point(e, x + 3 * i, t, v, p + i, NULL);
        memcpy(u + e->dim * i, v, (size_t)e->dim * sizeof *u);
        if (gu)
            add_gradients(e, t, x + 3 * i, gu + 3 * e->dim * i, gp + 3 * i);
    }
}

/* Places come in columns: over the same x the surface is the same. */
void wave_outside_surface(void *ctx, double t, int n, const double *x, double *phi, double *gphi)
{
    const struct exact *e = ctx;
    const double h = step * e->height;
    double last = NAN, height = 0.0, slope = 0.0;
    for (int i = 0; i < n; i++) {
        const double *at = x + 3 * i;
        if (at[0] != last) {
            const double low = exact_surface_at(e, at[0] - h, t),
                         high = exact_surface_at(e, at[0] + h, t);
            last = at[0];
            height = 0.5 * (low + high);
            slope = 0.5 * (high - low) / h;
        }
        const double per = 1.0 / hypot(1.0, slope);
        phi[i] = per * (at[1] - height);
        if (!gphi)
            continue;
        gphi[3 * i] = -per * slope;
        gphi[3 * i + 1] = per;
        gphi[3 * i + 2] = 0.0;
    }
}
