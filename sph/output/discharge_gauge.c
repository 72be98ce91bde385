/* discharge_gauge.c - see discharge_gauge.h. Volume times velocity across the section, weighted by
 * a hat function of the distance from it, 4 dx wide, whose integral is 1: exact for a lattice. What
 * stands beside the ends counts by the part of its cell between them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "discharge_gauge.h"

#include <math.h>

static const double half = 2.0; /* dx: half width of the hat function */

/* The section: direction across it, the extents along it. */
struct gauge_section {
    double across[3], along[2][3], length[2];
    int n; /* of extents */
};

static struct gauge_section section_of(const struct sph *s, const struct scene_probe *g)
{
    struct gauge_section c = {.n = 0};
    double d[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < s->dim; a++)
        d[a] = g->to[a] - g->at[a];
    if (s->dim == 2) {
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

static double project(const double *direction, const double *x, const double *from, int dim)
{
    double sum = 0.0;
    for (int a = 0; a < dim; a++)
        sum += direction[a] * (x[a] - (from ? from[a] : 0.0));
    return sum;
}

static double flow_of(const struct sph *s, const struct scene_probe *g,
                      const struct gauge_section *c, double dx)
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
    const struct gauge_section c = section_of(s, g);
    double sum = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        sum += flow_of(q, g, &c, s->dx);
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return sum;
}
