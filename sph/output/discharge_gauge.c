/* discharge_gauge.c - the discharge through a line or a rectangle. With n the unit vector across
 * the section and h the hat function of half width 2 dx,
 *   Q = sum_j w_j (u_j.n) h((x_j - x_s).n) share_j,
 * share_j the part of the particle's cell, as wide as its spacing along each direction of the
 * section, that lies between its ends. The integral of h is 1, so Q is exact for a lattice. The
 * width of h is that of the coarsest level for all, since it must be wide against the spacing of
 * each. Particles count with their images across periods; a section closer than 3 dx to a side
 * through which fluid leaves or enters is read that far inside, where h has particles on both
 * sides, and none that a face of the side still holds. Called once per row of the series.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "discharge_gauge.h"

#include <math.h>

#include "../../common/scene/scene.h"

static const double half = 2.0, inside = 3.0; /* dx: half width of the hat; from open sides */

/* direction.(x - from), or direction.x with from NULL. */
static double project(const double *direction, const double *x, const double *from, int dim)
{
    double sum = 0.0;
    for (int a = 0; a < dim; a++)
        sum += direction[a] * (x[a] - (from ? from[a] : 0.0));
    return sum;
}

/* The section where it is read. */
struct gauge_section {
    struct probe_section is;
    double at[3], width; /* m: one corner; half width of the hat function */
};

/* Whether nothing holds fluid back at a side of the region. */
static bool is_passable(const struct sph *s, int side)
{
    const struct scene_wall *w =
        scene_wall_of(&s->run->scene, (enum scene_side)(SIDE_X_MIN + side));
    return !s->periodic[side / 2] && (s->open[side] || !w || scene_wall_opens(w));
}

/* What is outside the region stays there. */
static struct gauge_section place(const struct sph *s, const struct scene_probe *g)
{
    struct gauge_section c = {.is = probe_section_of(g, s->dim), .width = half * s->dx};
    for (int a = 0; a < s->dim; a++) {
        const double lo = s->lo[a], hi = s->hi[a], near = 1e-6 * s->dx, x = g->at[a];
        const double depth = fmin(inside * s->dx, 0.5 * (hi - lo));
        c.at[a] = x;
        if (fabs(c.is.across[a]) != 1.0 || x < lo - near || x > hi + near)
            continue;
        if (x < lo + depth && is_passable(s, 2 * a))
            c.at[a] = lo + depth;
        if (x > hi - depth && is_passable(s, 2 * a + 1))
            c.at[a] = hi - depth;
    }
    return c;
}

/* Shift to image k of 27, m; false: there is none, or it has nothing near the section. */
static bool image(const struct sph *s, const struct gauge_section *c, int k, double shift[3])
{
    int digits = k;
    for (int a = 0; a < s->dim; a++, digits /= 3) {
        const int way = (digits + 1) % 3 - 1; /* 0, 1, -1 */
        double low = 0.0, high = 0.0;
        for (int i = 0; i < c->is.n; i++) {
            const double to = c->is.along[i][a] * c->is.length[i];
            low += fmin(to, 0.0);
            high += fmax(to, 0.0);
        }
        shift[a] = way * (s->hi[a] - s->lo[a]);
        if (way != 0 && (!s->periodic[a] || c->at[a] + low - c->width > s->hi[a] + shift[a] ||
                         c->at[a] + high + c->width < s->lo[a] + shift[a]))
            return false;
    }
    return digits == 0;
}

/* The sum over the flowing particles of one level of this rank, shifted, m^dim/s. */
static double flow_of(const struct sph *s, const struct gauge_section *c, const double *shift)
{
    double sum = 0.0, from[3];
    for (int a = 0; a < s->dim; a++)
        from[a] = c->at[a] - shift[a];
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i);
        const double d = fabs(project(c->is.across, q, from, s->dim)) / c->width;
        double part = d < 1.0 ? (1.0 - d) / c->width : 0.0;
        if (part == 0.0 || particles_is_guard(&s->p, i))
            continue;
        for (int k = 0; k < c->is.n; k++) {
            const double at = project(c->is.along[k], q, from, s->dim) / s->dx;
            const double end = c->is.length[k] / s->dx;
            part *= fmax(0.0, fmin(fmin(at + 0.5, end - at + 0.5), fmin(1.0, end)));
        }
        sum += part * q[at_volume(s->dim)] * project(c->is.across, q + s->dim, NULL, s->dim);
    }
    return sum;
}

double discharge_gauge(struct sph *s, const struct scene_probe *g)
{
    const struct gauge_section c = place(s, g);
    double sum = 0.0, shift[3];
    for (int k = 0; k < 27; k++)
        for (const struct sph *q = s; q && image(s, &c, k, shift); q = q->finer)
            sum += flow_of(q, &c, shift);
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return sum;
}
