/* discharge_gauge.c - the discharge through a line or a rectangle. With n the unit vector across
 * the section and h the hat function of half width 2 dx,
 *   Q = sum_j w_j (u_j.n) h((x_j - x_s).n) share_j,
 * share_j the part of the particle's cell, as wide as its spacing along each direction of the
 * section, that lies between its ends. At an end that stands on a wall no cell is cut, for in films
 * particles come nearer to the wall than half of their spacing, and a sloping wall is lower on one
 * side of the section: there all count that have no wall between themselves and the end. The
 * integral of h is 1, so Q is exact for a lattice. The width of h is that of the coarsest level for
 * all, since it must be wide against the spacing of each. Particles count with their images across
 * periods; a section closer than 3 dx to a side through which fluid leaves or enters is read that
 * far inside, where h has particles on both sides, and none that a face of the side still holds.
 * Called once per row of the series. SPDX-License-Identifier: BSD-3-Clause */
#include "discharge_gauge.h"

#include "../../common/scene/scene.h"
#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"

static const double half = 2.0;    /* dx: half width of the hat */
static const double beside = 0.25; /* dx: from an end, where walls are looked for */

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
    bool stands[2][2];   /* the lower and upper end along each direction: on a wall */
};

/* Whether a wall or a closed side is at an end of the section, in the middle of its breadth. */
static bool stands_on_wall(const struct sph *s, const struct gauge_section *c, int k, int end)
{
    double x[3] = {0.0, 0.0, 0.0}, d[3] = {0.0, 0.0, 0.0};
    bool out = false;
    for (int a = 0; a < s->dim; a++) {
        x[a] = c->at[a];
        for (int m = 0; m < c->is.n; m++)
            x[a] += c->is.along[m][a] * c->is.length[m] * (m == k ? end : 0.5);
        d[a] = (end ? 1.0 : -1.0) * 2.0 * beside * s->dx * c->is.along[k][a];
        x[a] -= 0.5 * d[a];
        const int side = x[a] + d[a] < s->lo[a] ? 2 * a : x[a] + d[a] > s->hi[a] ? 2 * a + 1 : -1;
        out = out || (side >= 0 && !s->periodic[a] && !region_side_passes(s, side));
    }
    return out || (s->walls && walls_meet(s, x, d) < 1.0);
}

/* What is outside the region stays there. */
static struct gauge_section place(const struct sph *s, const struct scene_probe *g)
{
    struct gauge_section c = {.is = probe_section_of(g, s->dim), .width = half * s->dx};
    for (int a = 0; a < s->dim; a++)
        c.at[a] = fabs(c.is.across[a]) == 1.0 ? region_clear(s, a, g->at[a], region_side_passes)
                                              : g->at[a];
    for (int k = 0; k < 2 * c.is.n; k++)
        c.stands[k / 2][k % 2] = stands_on_wall(s, &c, k / 2, k % 2);
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

/* Whether nothing is between the particle at x, d m off the section, and its end, which is `up' m
 * up from the particle along direction k. */
static bool reaches_end(const struct sph *s, const struct gauge_section *c, int k, double up,
                        const double *x, double d)
{
    double way[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < s->dim; a++)
        way[a] = up * c->is.along[k][a] - d * c->is.across[a];
    return !s->walls || walls_meet(s, x, way) >= 1.0;
}

/* Part of the cell of the particle at x, d m off the section, that is between its ends along
 * direction k; `at' is its place there, m. */
static double share_between(const struct sph *s, const struct gauge_section *c, int k, double at,
                            const double *x, double d)
{
    const double length = c->is.length[k], near = beside * s->dx;
    double low = at / s->dx + 0.5, high = (length - at) / s->dx + 0.5, most = length / s->dx;
    if (c->stands[k][0] && low < 1.0)
        low = at >= 0.0 || (at > -c->width && reaches_end(s, c, k, near - at, x, d));
    if (c->stands[k][1] && high < 1.0)
        high = at <= length ||
               (at < length + c->width && reaches_end(s, c, k, length - near - at, x, d));
    if (c->stands[k][0] && c->stands[k][1])
        most = 1.0;
    return fmax(0.0, fmin(fmin(low, high), fmin(1.0, most)));
}

/* The sum over the particles of one level of this rank, m^dim/s. Where levels meet each counts by
 * its share: by their roles rows of the coarser one, half of which is beyond the edge, were in or
 * out as a whole (2 % of a stream 25 rows deep). */
static double flow_of(const struct sph *s, const struct gauge_section *c)
{
    double sum = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i);
        const double d = project(c->is.across, q, c->at, s->dim), off = fabs(d) / c->width;
        double part = off < 1.0 ? (1.0 - off) / c->width : 0.0;
        if (part == 0.0)
            continue;
        for (int k = 0; k < c->is.n && part > 0.0; k++)
            part *= share_between(s, c, k, project(c->is.along[k], q, c->at, s->dim), q, d);
        part *= part > 0.0 ? particles_share(s, q) : 1.0;
        sum += part * q[at_volume(s->dim)] * project(c->is.across, q + s->dim, NULL, s->dim);
    }
    return sum;
}

double discharge_gauge(struct sph *s, const struct scene_probe *g)
{
    const struct gauge_section c = place(s, g);
    double sum = 0.0, shift[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 27; k++) {
        if (!image(s, &c, k, shift))
            continue;
        struct gauge_section shifted = c;
        vec3_add(shifted.at, -1.0, shift);
        for (const struct sph *q = s; q; q = q->finer)
            sum += flow_of(q, &shifted);
    }
    return ranks_sum(s->run->comm, sum);
}
