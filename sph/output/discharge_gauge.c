/* discharge_gauge.c - the discharge through a line or a rectangle. With n the unit vector across
 * the section and h the hat function of half width 2 dx,
 *   Q = sum_j w_j (u_j.n) h((x_j - x_s).n) share_j,
 * share_j the part of the particle's cell, dx wide along each direction of the section, that lies
 * between its ends. The integral of h is 1, so Q is exact for a lattice. Widths are those of the
 * coarsest level for all, since h must be wide against the spacing of each. Called once per row of
 * the series that has such a gauge.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "discharge_gauge.h"

#include <math.h>

#include "../../common/scene/scene.h"

static const double half = 2.0; /* dx: half width of the hat function */

/* direction.(x - from), or direction.x with from NULL. */
static double project(const double *direction, const double *x, const double *from, int dim)
{
    double sum = 0.0;
    for (int a = 0; a < dim; a++)
        sum += direction[a] * (x[a] - (from ? from[a] : 0.0));
    return sum;
}

/* The sum over the flowing particles of one level of this rank, m^dim/s. */
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

/* Positions are not wrapped around periods: the section lies within the domain. */
double discharge_gauge(struct sph *s, const struct scene_probe *g)
{
    const struct probe_section c = probe_section_of(g, s->dim);
    double sum = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        sum += flow_of(q, g, &c, s->dx);
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return sum;
}
