/* fv_probes.c - gauges of the case in series.csv: pressure at a point, linear between the centres
 * of cells and beyond them at a wall; level of the water. SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "levelset.h"

/* The same among rows of unequal height. */
static int row_below(const struct block *b, double y, double *weight)
{
    const double *e = b->rows->edge;
    int i = 0;
    while (i < b->cells[1] - 2 && 0.5 * (e[i + 1] + e[i + 2]) <= y)
        i++;
    *weight = (y - 0.5 * (e[i] + e[i + 1])) / (0.5 * (e[i + 2] - e[i]));
    return i;
}

/* Cell below x along axis a, so that it and the next one are cells of the grid; *weight of the
 * next. */
static int base(const struct block *b, int a, double x, double *weight)
{
    if (a == 1 && b->rows)
        return row_below(b, x, weight);
    const double at = (x - b->origin[a]) / b->h[a] - 0.5;
    int i = (int)floor(at);
    if (!b->periodic[a])
        i = i < 0 ? 0 : i > b->cells[a] - 2 ? b->cells[a] - 2 : i;
    *weight = at - i;
    return b->periodic[a] ? (i % b->cells[a] + b->cells[a]) % b->cells[a] : i;
}

/* Whether the cell that x lies in is dry. */
static bool dry_at(const struct fv *s, const int *i, const double *w)
{
    int at[3];
    for (int a = 0; a < 3; a++)
        at[a] = i[a] + (w[a] > 0.5);
    return s->surface->layer[block_at(&s->b, at[0], at[1], at[2])] != 0;
}

/* What this rank has to say: 0 unless the lower cell is its own. */
static double pressure_at(const struct fv *s, const double *x)
{
    const struct block *b = &s->b;
    int i[3] = {0, 0, 0};
    double w[3] = {0.0, 0.0, 0.0}, sum = 0.0;
    for (int a = 0; a < b->dim; a++) {
        i[a] = base(b, a, x[a], w + a) - b->lo[a];
        if (i[a] < 0 || i[a] >= b->n[a])
            return 0.0;
    }
    if (s->surface && dry_at(s, i, w))
        return 0.0;
    for (int m = 0; m < 1 << b->dim; m++) {
        double f = 1.0;
        int at[3];
        for (int a = 0; a < 3; a++) {
            const int up = m >> a & 1;
            at[a] = i[a] + up;
            f *= up ? w[a] : 1.0 - w[a];
        }
        sum += f * fv_pressure(s, block_at(b, at[0], at[1], at[2]));
    }
    return sum + fv_still_pressure(s, x) + coupling_datum(s);
}

/* A partner has the surface. */
static bool is_mine(const struct run *r, int k)
{
    return r->scene.probes[k].kind == PROBE_PRESSURE || !r->coupled;
}

int fv_probe_columns(const struct run *r, const char **columns)
{
    static char names[PROBES_MAX][PARAM_TEXT_SIZE + 8];
    int n = 0;
    for (int k = 0; k < r->scene.nprobes; k++)
        if (is_mine(r, k)) {
            snprintf(names[n], sizeof names[n], "%s [%s]", r->scene.probes[k].name,
                     r->scene.probes[k].kind == PROBE_PRESSURE ? "Pa" : "m");
            columns[n] = names[n];
            n++;
        }
    return n;
}

void fv_probe(struct fv *s, double *values)
{
    const struct scene *scene = &s->run->scene;
    if (scene->nprobes == 0)
        return;
    block_halo(&s->b, 2, (double *const[]){s->p, s->p_before});
    int n = 0;
    for (int k = 0; k < scene->nprobes; k++)
        if (is_mine(s->run, k))
            values[n++] = scene->probes[k].kind == PROBE_LEVEL
                              ? surface_level(s, scene->probes[k].at)
                              : pressure_at(s, scene->probes[k].at);
    MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, s->b.cart);
}
