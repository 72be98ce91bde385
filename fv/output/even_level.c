/* even_level.c - level of the water over a place, on uniform cells and layers: of the columns of
 * cells around it, linear between their centres. Beside a box that is cut out the water ends at the
 * box: columns with other boxes than the place's own say nothing of it. A column stands on the box
 * next below the place (the place in a box: on that), else on the domain's end. A box above the
 * place with water on it counts as water where no air is left below it; else the column ends there.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "output.h"

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

/* A column from the end of the domain to which gravity draws: its ground, in cells, then the parts
 * of it above that are free of boxes, from one height to another, with their water, m. */
struct stretch {
    int n, from[BLOCKED_MAX + 1], to[BLOCKED_MAX + 1];
    double water[BLOCKED_MAX + 1];
};

/* Heights, in cells, of the boxes that a column meets; n. */
static int solids_in(const struct fv *s, const int *cell, int up, bool down, int (*solid)[2])
{
    const unsigned met = boxes_in(s, cell, up);
    const int N = s->b.cells[up];
    int n = 0;
    for (int k = 0; k < s->prm.nboxes; k++) {
        int lo[3], hi[3];
        if (!(met >> k & 1))
            continue;
        blocked_cells(&s->run->scene.domain, &s->prm, k, lo, hi);
        solid[n][0] = down ? N - hi[up] : lo[up];
        solid[n++][1] = down ? N - lo[up] : hi[up];
    }
    return n;
}

/* Where a solid that a height is in ends; they may touch. */
static int out_of(int height, int n, int (*solid)[2])
{
    for (int tries = 0; tries < n; tries++)
        for (int k = 0; k < n; k++)
            if (solid[k][0] <= height && height < solid[k][1])
                height = solid[k][1];
    return height;
}

/* Over the place of coordinate x along the axis, on a face the upper cell. */
static struct stretch stretch_over(const struct fv *s, const int *cell, int up, bool down, double x)
{
    const struct block *b = &s->b;
    const int N = b->cells[up];
    struct stretch c = {.n = 0};
    int solid[BLOCKED_MAX][2], from = 0;
    const int n = s->blocked ? solids_in(s, cell, up, down, solid) : 0;
    const double over = (down ? b->origin[up] + b->length[up] - x : x - b->origin[up]) / b->h[up];
    const int place = out_of((int)fmax(0.0, fmin(over + 1e-6, N - 1.0)), n, solid);
    for (int k = 0; k < n; k++)
        from = solid[k][1] <= place && solid[k][1] > from ? solid[k][1] : from;
    do {
        int next = N;
        for (int k = 0; k < n; k++)
            next = solid[k][0] >= from && solid[k][0] < next ? solid[k][0] : next;
        c.from[c.n] = from;
        c.to[c.n] = next;
        c.water[c.n++] = 0.0;
        from = out_of(next, n, solid);
    } while (from < N);
    return c;
}

/* Adds the water of this rank's cells. */
static void add_water(const struct fv *s, const int *cell, int up, bool down, struct stretch *c)
{
    const struct block *b = &s->b;
    int at[3];
    for (int a = 0; a < 3; a++) {
        at[a] = a == up || a >= s->dim ? 0 : cell[a] - b->lo[a];
        if (at[a] < 0 || at[a] >= b->n[a])
            return;
    }
    for (at[up] = 0; at[up] < b->n[up]; at[up]++) {
        const int i = b->lo[up] + at[up], height = down ? b->cells[up] - 1 - i : i;
        for (int k = 0; k < c->n; k++)
            if (c->from[k] <= height && height < c->to[k])
                c->water[k] +=
                    block_size(b, up, at[up]) * surface_water(s, block_at(b, at[0], at[1], at[2]));
    }
}

/* Height of the water over the domain's end, m: of cells of height h where there are boxes. */
static double height_of(const struct stretch *c, double h)
{
    double sum = h * c->from[0] + c->water[0];
    for (int k = 1; k < c->n; k++) {
        const bool air = c->water[k - 1] < h * (c->to[k - 1] - c->from[k - 1] - 0.5);
        if (air || c->water[k] <= 0.0)
            break;
        sum += h * (c->from[k] - c->to[k - 1]) + c->water[k];
    }
    return sum;
}

/* Only where boxes lie above the place it matters to all ranks what each has. */
double surface_level(const struct fv *s, const double *x)
{
    const struct block *b = &s->b;
    const int up = still_upright(&s->run->scene);
    const bool down = s->run->scene.fluid.gravity[up] > 0.0; /* the water hangs at the upper end */
    const struct columns c = columns_over(s, x, up);
    int rank;
    MPI_Comm_rank(b->cart, &rank);
    double sum = 0.0, all = down ? -(b->origin[up] + b->length[up]) : b->origin[up];
    for (int i = 0; i < c.n; i++) {
        if (!(c.weight[i] > 0.0))
            continue;
        struct stretch of = stretch_over(s, c.cell[i], up, down, x[up]);
        add_water(s, c.cell[i], up, down, &of);
        if (of.n > 1) {
            MPI_Allreduce(MPI_IN_PLACE, of.water, of.n, MPI_DOUBLE, MPI_SUM, s->comm);
            all += c.weight[i] * height_of(&of, b->h[up]);
        } else {
            all += c.weight[i] * b->h[up] * of.from[0];
            sum += c.weight[i] * of.water[0];
        }
    }
    return sum + (rank == 0 ? all : 0.0); /* against gravity, as keys of levels are */
}
