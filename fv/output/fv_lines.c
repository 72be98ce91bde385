/* fv_lines.c - extrema of velocity on the centre lines of the block, as cavities are compared by
 * (Botella & Peyret 1998); with a list of blocks, of the domain.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include <math.h>

#include "../../common/base/mem.h"
#include "../fv.h"
#include "../grid/mesh.h"
#include "../grid/overset.h"
#include "mesh_output.h"
#include "output.h"

/* Value at the middle of the domain along the stride, from the cell c right of it (or around it,
 * for an odd count): face average, or centre of a cell average. */
static double middle(const double *q, int64_t d, bool odd)
{
    if (odd)
        return (26.0 * q[0] - q[d] - q[-d]) / 24.0;
    return (7.0 * (q[0] + q[-d]) - (q[d] + q[-2 * d])) / 12.0;
}

/* Averages along the line of component q at the middle of axis `across', cell by cell along the
 * other one, on all ranks; NEW, with a ghost on each side. */
static double *line_of(const struct fv *s, int q, int across)
{
    const struct block *b = &s->b;
    const int along = 1 - across, n = b->cells[along], centre = b->cells[across] / 2;
    double *line = NEW(double, n + 2);
    int at[3] = {0, 0, b->cells[2] / 2 - b->lo[2]};
    at[across] = centre - b->lo[across];
    if (at[across] >= 0 && at[across] < b->n[across] && at[2] >= 0 && at[2] < b->n[2])
        for (int i = 0; i < b->n[along]; i++) {
            at[along] = i;
            line[1 + b->lo[along] + i] = middle(s->u[q] + block_at(b, at[0], at[1], at[2]),
                                                b->stride[across], b->cells[across] % 2);
        }
    MPI_Allreduce(MPI_IN_PLACE, line, n + 2, MPI_DOUBLE, MPI_SUM, b->cart);
    return line;
}

/* Largest value of sign f(x), f the quartic through the five points around the largest one; the
 * points from the averages by a second difference. */
static double extremum(const double *line, int n, double sign)
{
    double *f = NEW(double, n), best = -INFINITY;
    int top = 3;
    for (int i = 1; i < n - 1; i++)
        f[i] = sign * (26.0 * line[1 + i] - line[i] - line[2 + i]) / 24.0;
    for (int i = 3; i < n - 3; i++)
        if (f[i] > f[top])
            top = i;
    for (double x = -1.0; x <= 1.0; x += 1e-3) {
        double sum = 0.0;
        for (int m = -2; m <= 2; m++) {
            double weight = 1.0;
            for (int k = -2; k <= 2; k++)
                weight *= k == m ? 1.0 : (x - k) / (m - k);
            sum += weight * f[top + m];
        }
        best = fmax(best, sum);
    }
    mem_free(f);
    return sign * best;
}

static void on_even_cells(const struct fv *s, double found[3])
{
    double *const lines[2] = {line_of(s, 0, 0), line_of(s, 1, 1)};
    found[0] = extremum(lines[0], s->b.cells[1], -1.0);
    found[1] = extremum(lines[1], s->b.cells[0], 1.0);
    found[2] = extremum(lines[1], s->b.cells[0], -1.0);
    mem_free(lines[0]);
    mem_free(lines[1]);
}

/* Least and largest value of component q on the line through the middle along the other axis: the
 * cubics through the averages, looked at closely. */
static void search_line(const struct fv *s, const struct overset *o, int q, double ends[2])
{
    enum { POINTS = 4000 };
    const double *min = s->run->scene.domain.min, *max = s->run->scene.domain.max;
    double *line = NEW(double, POINTS), x[3];
    for (int a = 0; a < 3; a++)
        x[a] = 0.5 * (min[a] + max[a]);
    for (int k = 0; k < POINTS; k++) {
        x[1 - q] = min[1 - q] + (k + 0.5) / POINTS * (max[1 - q] - min[1 - q]);
        line[k] = mesh_value_at(s, o, x, 4, s->u[q]);
    }
    MPI_Allreduce(MPI_IN_PLACE, line, POINTS, MPI_DOUBLE, MPI_SUM, s->m->comm);
    ends[0] = INFINITY;
    ends[1] = -INFINITY;
    for (int k = 0; k < POINTS; k++) {
        ends[0] = fmin(ends[0], line[k]);
        ends[1] = fmax(ends[1], line[k]);
    }
    mem_free(line);
}

static void on_blocks(const struct fv *s, double found[3])
{
    struct overset *o = overset_search(s->run, s->m);
    double u[2], v[2];
    search_line(s, o, 0, u);
    search_line(s, o, 1, v);
    found[0] = u[0];
    found[1] = v[1];
    found[2] = v[0];
    overset_free(&o);
}

void fv_summarise_extrema(const struct fv *s)
{
    double found[3];
    if (s->m)
        on_blocks(s, found);
    else
        on_even_cells(s, found);
    summary_extrema(s->run->summary, found, s->prm.extrema);
}
