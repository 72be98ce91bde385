/* layout.c - how the ranks that wrote a restart file divided its grid. A file holds each rank's
 * cells with their ghosts as one run of records, and in dataset `name' eleven integers for each
 * box. On another number of ranks layout_read looks for each box of a writer that meets this rank's
 * box and copies the common cells, so that a run can go on with ghosts as they were, not merely
 * with cells. O(boxes) reads, each of the boxes that are needed.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "layout.h"

#include "../../common/files/files.h"
#include "block.h"

enum { NUMBERS = 11 }; /* that make a box: grid, lo, n, g, base */

struct layout_box layout_block(const struct block *b)
{
    struct layout_box x = {0};
    memcpy(x.lo, b->lo, sizeof x.lo);
    memcpy(x.n, b->n, sizeof x.n);
    memcpy(x.g, b->g, sizeof x.g);
    return x;
}

/* As many integers from each rank as it has boxes. */
void layout_save(struct h5 *f, const char *name, int n, const struct layout_box *of)
{
    int64_t *rows = NEW(int64_t, NUMBERS * (size_t)n), *to = rows;
    for (int k = 0; k < n; k++) {
        *to++ = of[k].grid;
        for (int a = 0; a < 3; a++)
            *to++ = of[k].lo[a];
        for (int a = 0; a < 3; a++)
            *to++ = of[k].n[a];
        for (int a = 0; a < 3; a++)
            *to++ = of[k].g[a];
        *to++ = of[k].base;
    }
    h5_write_int(f, name, NUMBERS * (int64_t)n, rows);
    mem_free(rows);
}

/* The inverse of what layout_save writes. */
static struct layout_box box_from(const int64_t *row)
{
    struct layout_box x = {.grid = (int)row[0], .base = row[NUMBERS - 1]};
    for (int a = 0; a < 3; a++) {
        x.lo[a] = (int)row[1 + a];
        x.n[a] = (int)row[4 + a];
        x.g[a] = (int)row[7 + a];
    }
    return x;
}

/* writer[k] follows from how many numbers each rank wrote. */
struct layout *layout_load(struct h5 *f, const char *name)
{
    int64_t n;
    int64_t *rows = h5_read_all_int(f, name, &n), *first = h5_first_rows(f, name);
    struct layout *l = rows && first ? NEW(struct layout, 1) : NULL;
    if (l) {
        l->nboxes = (int)(n / NUMBERS);
        l->of = NEW_IN(l, struct layout_box, l->nboxes);
        l->writer = NEW_IN(l, int, l->nboxes);
    }
    for (int k = 0, w = 0; l && k < l->nboxes; k++) {
        while (first[w + 1] <= (int64_t)k * NUMBERS)
            w++;
        l->of[k] = box_from(rows + (int64_t)k * NUMBERS);
        l->writer[k] = w;
    }
    FREE(rows, first);
    return l;
}

/* The largest end of all boxes of this grid along each axis. */
static void cells_of(const struct layout *l, int grid, int cells[3])
{
    memset(cells, 0, 3 * sizeof *cells);
    for (int k = 0; k < l->nboxes; k++)
        for (int a = 0; a < 3 && l->of[k].grid == grid; a++) {
            const int end = l->of[k].lo[a] + l->of[k].n[a];
            cells[a] = end > cells[a] ? end : cells[a];
        }
}

/* Files that do not say count as being of this number. */
bool layout_same_ranks(const struct h5 *f, int size)
{
    return h5_ranks(f) == 0 || h5_ranks(f) == size;
}

bool layout_fits(const struct layout *l, int grid, const int cells[3])
{
    int then[3];
    cells_of(l, grid, then);
    if (then[0] == cells[0] && then[1] == cells[1] && then[2] == cells[2])
        return true;
    log_say("the restart file is of %d x %d x %d cells, the case of %d x %d x %d", then[0], then[1],
            then[2], cells[0], cells[1], cells[2]);
    return false;
}

/* Number of cells of a box along axis a, ghosts included. */
static int width(const struct layout_box *x, int a) { return x->n[a] + 2 * x->g[a]; }

/* Records of a box; 0 for a rank without cells. */
static int64_t volume(const struct layout_box *x)
{
    return x->n[0] > 0 && x->n[1] > 0 && x->n[2] > 0
               ? (int64_t)width(x, 0) * width(x, 1) * width(x, 2)
               : 0;
}

/* Pairs of places along an axis, in the ghosted rows of mine and of `from', that are the same cell;
 * from's own, or beside its own beyond a closed end. Returns their number. pair[n] = {index in
 * mine, index in from}. Along an axis that wraps, ghosts are the cells of the other end. */
static int match(const struct layout_box *mine, const struct layout_box *from, int a, int cells,
                 bool wraps, int (*pair)[2])
{
    int n = 0;
    for (int i = 0; i < width(mine, a); i++) {
        int at = mine->lo[a] - mine->g[a] + i;
        if (wraps)
            at = (at % cells + cells) % cells;
        const int owned = at < 0 ? 0 : at >= cells ? cells - 1 : at;
        const int j = at - from->lo[a] + from->g[a];
        if (owned < from->lo[a] || owned >= from->lo[a] + from->n[a] || j < 0 ||
            j >= width(from, a))
            continue;
        pair[n][0] = i;
        pair[n++][1] = j;
    }
    return n;
}

/* What the box `from' has for mine; its rows are in v. pair[a], n[a]: along each axis as match has
 * them. */
static void copy(const struct layout_box *mine, const struct layout_box *from,
                 int (*const pair[3])[2], const int *n, int ncomp, const double *v, double *to)
{
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++) {
            const int64_t row = pair[1][j][0] + (int64_t)width(mine, 1) * pair[2][k][0];
            const int64_t other = pair[1][j][1] + (int64_t)width(from, 1) * pair[2][k][1];
            for (int i = 0; i < n[0]; i++)
                memcpy(to + ncomp * (pair[0][i][0] + (int64_t)width(mine, 0) * row),
                       v + ncomp * (pair[0][i][1] + (int64_t)width(from, 0) * other),
                       (size_t)ncomp * sizeof *to);
        }
}

/* Every rank reads in the same order, with no records where it needs none, since reading is
 * collective. */
bool layout_read(const struct layout *l, struct h5 *f, const char *name, int ncomp,
                 const struct layout_box *mine, const bool *wraps, double *to)
{
    int cells[3], (*pair[3])[2];
    int64_t *first = h5_first_rows(f, name);
    bool good = first != NULL;
    cells_of(l, mine->grid, cells);
    for (int a = 0; a < 3; a++)
        pair[a] = mem_new((size_t)width(mine, a), sizeof *pair[a]);
    for (int k = 0; good && k < l->nboxes; k++) {
        const struct layout_box *from = l->of + k;
        int n[3] = {0, 0, 0};
        if (from->grid != mine->grid)
            continue;
        for (int a = 0; a < 3 && volume(from) > 0 && volume(mine) > 0; a++)
            n[a] = match(mine, from, a, cells[a], wraps[a], pair[a]);
        const int64_t rows = n[0] > 0 && n[1] > 0 && n[2] > 0 ? volume(from) : 0;
        double *v = NEW(double, rows *ncomp);
        good = h5_read_real_at(f, name, rows > 0 ? first[l->writer[k]] + from->base : 0, rows,
                               ncomp, v);
        if (good && rows > 0)
            copy(mine, from, pair, n, ncomp, v, to);
        mem_free(v);
    }
    for (int a = 0; a < 3; a++)
        mem_free(pair[a]);
    mem_free(first);
    return good;
}
