/* discharge_gauge.c - see discharge_gauge.h. Volume times velocity across the section, weighted by
 * a hat function of the distance from it, 4 dx wide, whose integral is 1: exact for a lattice. What
 * stands beside the ends counts by the part of its cell between them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "discharge_gauge.h"

#include <math.h>

#include "../../common/scene/scene_probe.h"

static const double half = 2.0; /* dx: half width of the hat function */

static double project(const double *direction, const double *x, const double *from, int dim)
{
    double sum = 0.0;
    for (int a = 0; a < dim; a++)
        sum += direction[a] * (x[a] - (from ? from[a] : 0.0));
    return sum;
}

static double flow_of(const struct sph *s, const struct scene_probe *g,
                      const struct probe_section *c, double dx)
{
    double sum = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i);
        const double d = fabs(project(c->across, q, g->at, s->dim)) / dx;
        double part = d < half ? (1.0 - d / half) / (half * dx) : 0.0;
        if (part == 0.0 || particles_is_guard(&s->p, i))
            continue;
        for (int k = 0; k < c->n; k++) {
            const double at = project(c->along[k], q, g->at, s->dim) / dx, end = c->length[k] / dx;
            part *= fmax(0.0, fmin(fmin(at + 0.5, end - at + 0.5), 1.0));
        }
        sum += part * q[at_volume(s->dim)] * project(c->across, q + s->dim, NULL, s->dim);
    }
    return sum;
}

double discharge_gauge(struct sph *s, const struct scene_probe *g)
{
    const struct probe_section c = probe_section_of(g, s->dim);
    double sum = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        sum += flow_of(q, g, &c, s->dx);
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return sum;
}
