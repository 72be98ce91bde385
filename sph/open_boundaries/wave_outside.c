/* wave_outside.c - see wave_outside.h. A steady wave as the flow outside, for runs of SPH alone:
 * the same function that sets the start, evaluated at every stage; velocity and pressure with their
 * slopes (steady.h), and the surface as a level set of unit gradient, phi = (y - eta)/sqrt(1 +
 * eta_x^2).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wave_outside.h"

#include "../../common/scene/scene.h"
#include "../../common/waves/waves.h"

static const double step = 1e-4; /* of differences, over the depth */

bool wave_outside_wanted(const struct run *r, const struct sph_params *prm)
{
    return prm->outer == OUTER_EXACT && prm->surface == SURFACE_YES &&
           scene_has_steady_wave(&r->scene);
}

/* The wave varies along x and y alone. */
void wave_outside_eval(void *ctx, double t, int n, const double *x, double *u, double *p,
                       double *gu, double *gp)
{
    const struct exact *e = ctx;
    struct steady_slopes of;
    for (int i = 0; i < n; i++) {
        double v[3] = {0.0, 0.0, 0.0};
        steady_point_slopes(&e->steady, x[3 * i], x[3 * i + 1] - e->bottom - e->height, t, v, p + i,
                            gu ? &of : NULL);
        memcpy(u + e->dim * i, v, (size_t)e->dim * sizeof *u);
        if (!gu)
            continue;
        memset(gu + 3 * e->dim * i, 0, 3 * (size_t)e->dim * sizeof *gu);
        for (int a = 0; a < 2; a++)
            memcpy(gu + 3 * (e->dim * i + a), of.u[a], sizeof of.u[a]);
        memcpy(gp + 3 * i, (double[3]){of.p[0], of.p[1], 0.0}, 3 * sizeof *gp);
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
