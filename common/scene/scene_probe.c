/* scene_probe.c - see scene_probe.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_probe.h"

#include <math.h>

#include "../files/files.h"

bool probe_is_point(const struct scene_probe *g)
{
    return g->kind == PROBE_PRESSURE || g->kind == PROBE_VELOCITY;
}

bool probe_any(const struct scene *s, int kind)
{
    bool any = false;
    for (int k = 0; k < s->nprobes; k++)
        any = any || s->probes[k].kind == kind;
    return any;
}

int probe_columns(const struct scene_probe *g, int dim)
{
    return g->kind == PROBE_VELOCITY ? dim : 1;
}

void probe_row(const struct scene_probe *g, int dim, const double *v, struct figures *to)
{
    for (int a = 0; a < dim && g->kind == PROBE_VELOCITY; a++)
        FIGURE(to, v[a], "%s %c [m/s]", g->name, "uvw"[a]);
    if (g->kind != PROBE_VELOCITY)
        FIGURE(to, *v, "%s [%s]", g->name,
               g->kind == PROBE_PRESSURE    ? "Pa"
               : g->kind != PROBE_DISCHARGE ? "m"
               : dim == 2                   ? "m^2/s"
                                            : "m^3/s");
}

/* In 2D the normal points to the right of the line from at to `to'; in 3D along the axis that both
 * corners have in common. */
struct probe_section probe_section_of(const struct scene_probe *g, int dim)
{
    struct probe_section c = {.n = 0};
    double d[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < dim; a++)
        d[a] = g->to[a] - g->at[a];
    if (dim == 2) {
        c.length[0] = hypot(d[0], d[1]);
        for (int a = 0; a < 2; a++)
            c.along[0][a] = d[a] / c.length[0];
        c.across[0] = c.along[0][1];
        c.across[1] = -c.along[0][0];
        c.n = 1;
        return c;
    }
    for (int a = 0; a < 3; a++)
        if (d[a] == 0.0) {
            c.across[a] = 1.0;
        } else {
            c.along[c.n][a] = d[a] > 0.0 ? 1.0 : -1.0;
            c.length[c.n++] = fabs(d[a]);
        }
    return c;
}
