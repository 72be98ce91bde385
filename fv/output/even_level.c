/* even_level.c - level of the water over a place, on uniform cells and layers: of the columns of
 * cells around it, linear between their centres. Beside a box that is cut out the water ends at the
 * box: columns with other boxes than the place's own say nothing of it.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "output.h"

/* Water of a cell in a column, over the cell, with what is cut out below it: a box is ground for
 * the water on it, and on the floor of the domain whether there is water or not. */
static double height_in_column(const struct fv *s, const int *at, int64_t c, int up, int way)
{
    if (!s->blocked)
        return surface_water(s, c);
    const int stack = blocked_stack(s, at, up, way), i = s->b.lo[up] + at[up];
    const bool grounded = stack == (way < 0 ? i : s->b.cells[up] - 1 - i);
    if (is_blocked(s, c))
        return grounded;
    const double share = surface_water(s, c);
    return share + (share > 0.0 && !grounded ? stack : 0);
}

/* The two cells of the whole grid whose centres lie around x along an axis, and their weights; at a
 * side that is no period one has none. */
static void columns_beside(const struct block *b, int a, double x, int cell[2], double weight[2])
{
    const int n = b->cells[a];
    double place = (x - b->origin[a]) / b->h[a] - 0.5;
    if (!b->periodic[a])
        place = fmin(n - 1.0, fmax(0.0, place));
    const int i = (int)floor(place);
    weight[1] = place - i;
    weight[0] = 1.0 - weight[1];
    for (int k = 0; k < 2; k++)
        cell[k] = b->periodic[a] ? ((i + k) % n + n) % n : i + k;
}

/* The boxes that a column of cells of the whole grid meets, as bits. */
static unsigned boxes_in(const struct fv *s, const int *cell, int up)
{
    unsigned met = 0;
    for (int k = 0; k < s->prm.nboxes; k++) {
        int lo[3], hi[3];
        bool in = true;
        blocked_cells(&s->run->scene.domain, &s->prm, k, lo, hi);
        for (int a = 0; a < s->dim; a++)
            in = in && (a == up || (cell[a] >= lo[a] && cell[a] < hi[a]));
        met |= in ? 1u << k : 0u;
    }
    return met;
}

/* Columns along gravity around a place: up to four. */
struct columns {
    int n, cell[4][3]; /* of the whole grid; 0 along gravity */
    double weight[4];
};

/* Whether column j is nearer to the place than column i; of two as near the one with fewer boxes:
 * a gauge on the side of a box is in the water beside it. */
static bool is_nearer(const struct columns *c, const unsigned *met, int j, int i)
{
    const double more = c->weight[j] - c->weight[i];
    return more > 1e-9 || (more > -1e-9 && met[j] < met[i]);
}

/* Leaves the columns that meet the same boxes as the nearest one. */
static void keep_alike(const struct fv *s, struct columns *c, int up)
{
    unsigned met[4];
    int own = 0;
    double sum = 0.0;
    for (int i = 0; i < c->n; i++) {
        met[i] = boxes_in(s, c->cell[i], up);
        own = is_nearer(c, met, i, own) ? i : own;
    }
    for (int i = 0; i < c->n; i++) {
        c->weight[i] = met[i] == met[own] ? c->weight[i] : 0.0;
        sum += c->weight[i];
    }
    for (int i = 0; i < c->n; i++)
        c->weight[i] /= sum;
}

/* Each axis but that of gravity doubles the columns. */
static struct columns columns_over(const struct fv *s, const double *x, int up)
{
    struct columns c = {.n = 1, .weight = {1.0}};
    for (int a = 0; a < s->dim; a++) {
        int cell[2];
        double weight[2];
        if (a == up)
            continue;
        columns_beside(&s->b, a, x[a], cell, weight);
        for (int i = 0; i < c.n; i++) {
            memcpy(c.cell[c.n + i], c.cell[i], sizeof c.cell[i]);
            c.cell[i][a] = cell[0];
            c.cell[c.n + i][a] = cell[1];
            c.weight[c.n + i] = c.weight[i] * weight[1];
            c.weight[i] *= weight[0];
        }
        c.n *= 2;
    }
    if (s->blocked)
        keep_alike(s, &c, up);
    return c;
}

/* Height of the water in a column, this rank's share. */
static double column_height(const struct fv *s, const int *cell, int up, int way)
{
    const struct block *b = &s->b;
    int at[3];
    double sum = 0.0;
    for (int a = 0; a < 3; a++) {
        at[a] = a == up || a >= s->dim ? 0 : cell[a] - b->lo[a];
        if (at[a] < 0 || at[a] >= b->n[a])
            return 0.0;
    }
    for (at[up] = 0; at[up] < b->n[up]; at[up]++)
        sum += block_size(b, up, at[up]) *
               height_in_column(s, at, block_at(b, at[0], at[1], at[2]), up, way);
    return sum;
}

double surface_level(const struct fv *s, const double *x)
{
    const struct block *b = &s->b;
    const int up = still_upright(&s->run->scene);
    const bool down = s->run->scene.fluid.gravity[up] > 0.0; /* the water hangs at the upper end */
    const struct columns c = columns_over(s, x, up);
    double sum = 0.0;
    for (int i = 0; i < c.n; i++)
        if (c.weight[i] > 0.0)
            sum += c.weight[i] * column_height(s, c.cell[i], up, down ? 1 : -1);
    int rank;
    MPI_Comm_rank(b->cart, &rank);
    const double ground = down ? -(b->origin[up] + b->length[up]) : b->origin[up];
    return sum + (rank == 0 ? ground : 0.0); /* against gravity, as keys of levels are */
}
