/* box_union.c - the union of boxes, and what it leaves of space as boxes. The coordinates of all
 * faces cut space into cells, each inside or outside; cells outside are merged into boxes,
 * greedily, one axis after the other. A distance from outside is the least to the boxes, one from
 * inside the least to the rest: exact on both sides, unlike a maximum of distances within single
 * boxes. Made anew whenever regions move: (2 n + 1)^3 cells for n boxes, a few in practice.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "box_union.h"

#include "../../common/base/base.h"

/* Cells between the coordinates of faces: cell i of an axis from at[i] to at[i + 1]. */
struct cuts {
    int n[3];      /* cells */
    double *at[3]; /* [n + 1], from -INFINITY to INFINITY */
    char *open;    /* cell (i, j, k) at i + n[0] (j + n[1] k): outside and not yet in a box */
};

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Faces closer than near become one: boxes that share a face leave no gap between them. */
static void cut_axis(struct cuts *c, int a, int n, const struct box *box, double near)
{
    double *all = NEW(double, 2 * n);
    for (int k = 0; k < n; k++) {
        all[2 * k] = box[k].lo[a];
        all[2 * k + 1] = box[k].hi[a];
    }
    qsort(all, (size_t)(2 * n), sizeof *all, ascending);
    c->at[a] = NEW(double, 2 * n + 2);
    c->at[a][0] = -INFINITY;
    int m = 1;
    for (int k = 0; k < 2 * n; k++)
        if (isfinite(all[k]) && all[k] - c->at[a][m - 1] > near)
            c->at[a][m++] = all[k];
    c->at[a][m] = INFINITY;
    c->n[a] = m;
    mem_free(all);
}

/* The cut at or just below x: the first cell of a box that starts there. INFINITY gives the
 * number of cells, one beyond the last. */
static int cell_from(const struct cuts *c, int a, double x)
{
    return x == INFINITY ? c->n[a] : lookup_row(c->at[a], 1, c->n[a], x);
}

/* The mark of cell (i, j, k). */
static char *cell_of(const struct cuts *c, int i, int j, int k)
{
    return c->open + i + (ptrdiff_t)c->n[0] * (j + (ptrdiff_t)c->n[1] * k);
}

/* Whether all cells of [from, to) are open. */
static bool is_open(const struct cuts *c, const int *from, const int *to)
{
    for (int k = from[2]; k < to[2]; k++)
        for (int j = from[1]; j < to[1]; j++)
            for (int i = from[0]; i < to[0]; i++)
                if (!*cell_of(c, i, j, k))
                    return false;
    return true;
}

/* Sets the marks of all cells of [from, to). */
static void mark(const struct cuts *c, const int *from, const int *to, char value)
{
    for (int k = from[2]; k < to[2]; k++)
        for (int j = from[1]; j < to[1]; j++)
            memset(cell_of(c, from[0], j, k), value, (size_t)(to[0] - from[0]));
}

/* Appends a box of open cells that grows from its first cell along x as far as all cells are open,
 * then along y, then z, and closes these cells. */
static void grow_rest(struct box_union *u, struct cuts *c, const int *cell)
{
    int from[3], to[3];
    for (int a = 0; a < 3; a++) {
        from[a] = cell[a];
        to[a] = cell[a] + 1;
    }
    for (int a = 0; a < 3; a++)
        while (to[a] < c->n[a]) {
            int next[3] = {from[0], from[1], from[2]};
            next[a] = to[a]++;
            if (!is_open(c, next, to)) {
                to[a]--;
                break;
            }
        }
    mark(c, from, to, 0);
    GROW_IN(u->of, u->rest, u->nrest, u->nrest + 1);
    struct box *b = u->rest + u->nrest++;
    for (int a = 0; a < 3; a++) {
        b->lo[a] = c->at[a][from[a]];
        b->hi[a] = c->at[a][to[a]];
    }
}

/* Marks what the boxes cover and turns all other cells into boxes. */
static void find_rest(struct box_union *u, double near)
{
    struct cuts c;
    for (int a = 0; a < 3; a++)
        cut_axis(&c, a, u->n, u->of, near);
    const size_t cells = (size_t)c.n[0] * (size_t)c.n[1] * (size_t)c.n[2];
    c.open = NEW(char, cells);
    memset(c.open, 1, cells);
    for (int b = 0; b < u->n; b++) {
        int from[3], to[3];
        for (int a = 0; a < 3; a++) {
            from[a] = cell_from(&c, a, u->of[b].lo[a]);
            to[a] = cell_from(&c, a, u->of[b].hi[a]);
        }
        mark(&c, from, to, 0);
    }
    for (int k = 0; k < c.n[2]; k++)
        for (int j = 0; j < c.n[1]; j++)
            for (int i = 0; i < c.n[0]; i++)
                if (*cell_of(&c, i, j, k))
                    grow_rest(u, &c, (const int[3]){i, j, k});
    for (int a = 0; a < 3; a++)
        mem_free(c.at[a]);
    mem_free(c.open);
}

/* In 2D boxes are infinite along z, so that the code of three axes serves. */
struct box_union box_union_create(void *owner, int dim, int n, const struct box *box, double near)
{
    struct box_union u = {.dim = dim, .n = n, .near = near, .of = NEW_IN(owner, struct box, n)};
    if (n > 0)
        memcpy(u.of, box, (size_t)n * sizeof *box);
    for (int k = 0; k < n && dim == 2; k++) {
        u.of[k].lo[2] = -INFINITY;
        u.of[k].hi[2] = INFINITY;
    }
    if (n > 0)
        find_rest(&u, near);
    return u;
}

/* Squared distance to a box, 0 inside. */
static inline double apart(const struct box *b, const double *x, const int dim)
{
    double sum = 0.0;
    for (int a = 0; a < dim; a++) {
        const double low = b->lo[a] - x[a], high = x[a] - b->hi[a];
        const double out = low > high ? low : high, d = out > 0.0 ? out : 0.0;
        sum += d * d;
    }
    return sum;
}

/* Least squared distance to n boxes; dim is a constant in each caller, for this is called for every
 * particle. */
static inline double least(int n, const struct box *of, const double *x, const int dim)
{
    double d = INFINITY;
    for (int k = 0; k < n; k++) {
        const double e = apart(of + k, x, dim);
        d = e < d ? e : d;
    }
    return d;
}

/* Positions on the edge to `near' count as inside at the distance 0. */
double box_union_distance(const struct box_union *u, const double *x)
{
    const bool plane = u->dim == 2;
    const double out = plane ? least(u->n, u->of, x, 2) : least(u->n, u->of, x, 3);
    if (out > u->near * u->near)
        return -sqrt(out);
    return sqrt(plane ? least(u->nrest, u->rest, x, 2) : least(u->nrest, u->rest, x, 3));
}
