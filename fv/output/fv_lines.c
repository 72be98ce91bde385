/* fv_lines.c - extrema of velocity on the centre lines of the block, as cavities are compared by
 * (Botella & Peyret 1998); with a list of blocks, of the domain. From averages: middle and
 * in_layers take point values out of them to fourth order and more, since a column of averages
 * would hide an extremum between cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../grid/fv_grid.h"
#include "mesh_output.h"
#include "output.h"

enum { POINTS = 4000 }; /* at which a line is looked at */

/* Weights of the averages of the cells -2 to 1 beside the one right of the middle of an axis (or
 * around it, for an odd count): face average, or centre of a cell average. Even count: the middle
 * is a face. */
static const double *middle_weights(int cells)
{
    static const double of[2][4] = {{-1.0 / 12.0, 7.0 / 12.0, 7.0 / 12.0, -1.0 / 12.0},
                                    {0.0, -1.0 / 24.0, 26.0 / 24.0, -1.0 / 24.0}};
    return of[cells % 2];
}

/* Value in the plane in the middle of the third axis, of the cell beside it; in 2D its own. */
static double in_plane(const struct block *b, const double *q)
{
    const double *w = middle_weights(b->cells[2]);
    double sum = 0.0;
    if (b->dim == 2)
        return *q;
    for (int m = 0; m < 4; m++)
        sum += w[m] * q[(m - 2) * b->stride[2]];
    return sum;
}

/* The same in the middle of an axis of even cells, too. */
static double middle(const struct block *b, const double *q, int axis)
{
    const double *w = middle_weights(b->cells[axis]);
    double sum = 0.0;
    for (int m = 0; m < 4; m++)
        sum += w[m] * in_plane(b, q + (m - 2) * b->stride[axis]);
    return sum;
}

/* Value at y between the edges of n layers with averages q: the derivative of the polynomial
 * through their integral at the six edges around. Six edges, five layers: fifth order. */
static double in_layers(const double *edge, const double *q, int n, double y)
{
    int first = 0;
    double integral = 0.0, sum = 0.0;
    while (first < n - 5 && edge[first + 3] <= y)
        first++;
    const double *e = edge + first;
    for (int m = 0; m < 6; m++) {
        double slope = 0.0; /* of the polynomial that is 1 at edge m, 0 at the others */
        for (int k = 0; k < 6; k++) {
            double part = k == m ? 0.0 : 1.0 / (e[m] - e[k]);
            for (int l = 0; l < 6; l++)
                part *= l == m || l == k ? 1.0 : (y - e[l]) / (e[m] - e[l]);
            slope += part;
        }
        sum += slope * integral;
        integral += m < 5 ? q[first + m] * (e[m + 1] - e[m]) : 0.0;
    }
    return sum;
}

/* The layer that y lies in. */
static int layer_at(const struct block *b, double y)
{
    int j = 0;
    while (j < b->cells[1] - 1 && b->rows->edge[j + 1] <= y)
        j++;
    return j;
}

/* The same as middle, in layers: q at the one in which the middle lies. */
static double middle_of_layers(const struct block *b, const double *q, int layer)
{
    double near[5];
    for (int m = 0; m < 5; m++)
        near[m] = in_plane(b, q + (m - 2) * b->stride[1]);
    return in_layers(b->rows->edge + layer - 2, near, 5, b->origin[1] + 0.5 * b->length[1]);
}

/* Values of component q on the line through the middle of axis `across', averages cell by cell
 * along the other one, on all ranks; owned by the caller, with an empty place on each side.
 * Collective. */
static double *profile_across(const struct fv *s, int q, int across)
{
    const struct block *b = &s->b;
    const int along = 1 - across, n = b->cells[along];
    const bool layers = across == 1 && b->rows;
    const int centre =
        layers ? layer_at(b, b->origin[1] + 0.5 * b->length[1]) : b->cells[across] / 2;
    double *line = NEW(double, n + 2);
    int at[3] = {0, 0, b->cells[2] / 2 - b->lo[2]};
    at[across] = centre - b->lo[across];
    if (at[across] >= 0 && at[across] < b->n[across] && at[2] >= 0 && at[2] < b->n[2])
        for (int i = 0; i < b->n[along]; i++) {
            at[along] = i;
            const double *u = s->u[q] + block_at(b, at[0], at[1], at[2]);
            line[1 + b->lo[along] + i] =
                layers ? middle_of_layers(b, u, centre) : middle(b, u, across);
        }
    MPI_Allreduce(MPI_IN_PLACE, line, n + 2, MPI_DOUBLE, MPI_SUM, b->cart);
    return line;
}

/* Largest value of sign f(x), f the quartic through the five points around the largest one; the
 * points from the averages by a second difference. The three outermost cells at either end are left
 * out, where there are walls. The quartic is searched in steps of 1e-3 of a cell. */
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

/* Largest value of sign f(y) where f has these averages in layers. */
static double extremum_in_layers(const struct block *b, const double *line, double sign)
{
    double best = -INFINITY;
    for (int k = 0; k < POINTS; k++) {
        const double y = b->origin[1] + (k + 0.5) / POINTS * b->length[1];
        best = fmax(best, sign * in_layers(b->rows->edge, line + 1, b->cells[1], y));
    }
    return sign * best;
}

/* found: least u on the vertical line, most and least v on the horizontal one. */
static void on_even_cells(const struct fv *s, double found[3])
{
    block_halo(&s->b, s->dim, s->u);
    double *const lines[2] = {profile_across(s, 0, 0), profile_across(s, 1, 1)};
    found[0] = s->b.rows ? extremum_in_layers(&s->b, lines[0], -1.0)
                         : extremum(lines[0], s->b.cells[1], -1.0);
    found[1] = extremum(lines[1], s->b.cells[0], 1.0);
    found[2] = extremum(lines[1], s->b.cells[0], -1.0);
    FREE(lines[0], lines[1]);
}

/* Least and largest value of component q on the line through the middle along the other axis: the
 * cubics through the averages, looked at closely. POINTS places, each by the rank that has the
 * cells. Collective. */
static void search_line(const struct fv *s, const struct overset *o, int q, double ends[2])
{
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

/* As on_even_cells. */
static void on_blocks(const struct fv *s, double found[3])
{
    struct overset *o = overset_search(s->run, s->m);
    double u[2], v[2];
    search_line(s, o, 0, u);
    search_line(s, o, 1, v);
    found[0] = u[0];
    found[1] = v[1];
    found[2] = v[0];
    FREE(o);
}

/* Two axes, in 3D in the plane in the middle. */
void fv_summarise_extrema(const struct fv *s)
{
    double found[3];
    if (s->m)
        on_blocks(s, found);
    else
        on_even_cells(s, found);
    summary_extrema(s->run->summary, found, s->prm.extrema);
}
