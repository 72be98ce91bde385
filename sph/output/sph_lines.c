/* sph_lines.c - extrema of velocity on the centre lines of the domain, as cavities are compared by
 * (Botella & Peyret 1998). A point of a line takes the linear least-squares fit of the particles
 * around it (moving least squares), so that a linear field is exact up to the walls.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../pairs/sph_pairs.h"
#include "../sph.h"
#include "sph_output.h"

enum { SUMS = 9 }; /* moments 1 x y xx xy yy, then f, x f, y f */

/* Adds a particle to the moments of the points of a line within R. across: the velocity's
 * component, whose position along the other axis runs; moments are in units of R, so that their
 * matrix is well conditioned. */
static void add_particle(const struct sph *s, int i, int across, int n, double *sums)
{
    const int along = 1 - across;
    const double *q = prim_line(&s->p, i);
    const double h = (s->hi[along] - s->lo[along]) / n;
    const double off = q[across] - 0.5 * (s->lo[across] + s->hi[across]);
    const double from = (q[along] - s->lo[along] - s->R) / h, to = from + 2.0 * s->R / h;
    if (fabs(off) >= s->R)
        return;
    for (int k = (int)fmax(0.0, ceil(from)); k <= n && k <= to; k++) {
        double d[2], *m = sums + SUMS * (size_t)k;
        d[across] = off;
        d[along] = q[along] - s->lo[along] - k * h;
        const double r = sqrt(d[0] * d[0] + d[1] * d[1]);
        const double W = r < s->R ? q[4] * kernel_w(2, r, s->R) : 0.0;
        const double x = d[0] / s->R, y = d[1] / s->R, f = q[2 + across];
        const double more[SUMS] = {1.0, x, y, x * x, x * y, y * y, f, x * f, y * f};
        for (int c = 0; c < SUMS; c++)
            m[c] += W * more[c];
    }
}

/* Value at the point: first unknown of the normal equations, by Cramer's rule. */
static double fit(const double *m)
{
    const double a = m[3] * m[5] - m[4] * m[4], b = m[2] * m[4] - m[1] * m[5];
    const double c = m[1] * m[4] - m[2] * m[3], det = m[0] * a + m[1] * b + m[2] * c;
    return det != 0.0 ? (m[6] * a + m[7] * b + m[8] * c) / det : 0.0;
}

/* Values at n + 1 points of a centre line, owned by the caller (mem_free): of u along the vertical
 * (across 0), of v along the horizontal one. Collective. */
static double *profile_across(const struct sph *s, int across, int n)
{
    double *sums = NEW(double, SUMS *(size_t)(n + 1)), *f = NEW(double, n + 1);
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (!particles_is_guard(&q->p, i))
                add_particle(q, i, across, n, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, SUMS * (n + 1), MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int k = 0; k <= n; k++)
        f[k] = fit(sums + SUMS * (size_t)k);
    mem_free(sums);
    return f;
}

/* Largest value of sign f between the ends, by the parabola around the largest point. Interior
 * points only, since the ends are on walls. */
static double extremum(const double *f, int n, double sign)
{
    int top = 1;
    for (int k = 1; k < n; k++)
        if (sign * f[k] > sign * f[top])
            top = k;
    const double a = f[top - 1], b = f[top], c = f[top + 1], bend = a - 2.0 * b + c;
    return bend != 0.0 ? b - 0.125 * (c - a) * (c - a) / bend : b;
}

/* Twice as many points as particles along each line: least of u, most and least of v. */
void sph_summarise_extrema(const struct sph *s)
{
    const int n[2] = {2 * (int)lround((s->hi[0] - s->lo[0]) / s->dx),
                      2 * (int)lround((s->hi[1] - s->lo[1]) / s->dx)};
    double *const lines[2] = {profile_across(s, 0, n[1]), profile_across(s, 1, n[0])};
    const double found[3] = {extremum(lines[0], n[1], -1.0), extremum(lines[1], n[0], 1.0),
                             extremum(lines[1], n[0], -1.0)};
    summary_extrema(s->run->summary, found, s->prm.extrema);
    FREE(lines[0], lines[1]);
}
