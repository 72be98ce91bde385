/* wet_boxes.c - see wet_boxes.h. Rows of cells are taken together in tiles across; each tile has
 * one run of cells, to whole tiles along x, so that coarser grids fit; tiles with the same run that
 * follow one another along y are one box. Boxes stay while they hold the water and are not much
 * larger than they need be: other ones are another grid. Grids with a period are whole.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wet_boxes.h"

#include <limits.h>

#include "../surface/fv_surface.h"

enum { TILE = 8, SPARE = 2 }; /* cells; how many times what is needed boxes may have */

/* Tiles are those of the whole grid: ranks make no difference. Of a local cell its tile, counted
 * from the rank's first. */
static int tile_of(const struct block *b, int a, int i)
{
    return (b->lo[a] + i) / TILE - b->lo[a] / TILE;
}
/* Tiles that the rank's cells touch, whole or in part. */
static int tiles_of(const struct block *b, int a) { return tile_of(b, a, b->n[a] - 1) + 1; }

void wet_boxes_run(const unsigned char *layer, int n, int run[2])
{
    int first = 0, end = n;
    while (first < end && layer[first])
        first++;
    while (end > first && layer[end - 1])
        end--;
    run[0] = first < end ? first : 0;
    run[1] = end - first;
}

/* First tile and the one behind the last that holds water in a row from c on. */
static void look(const struct block *b, const unsigned char *layer, int run[2])
{
    int wet[2];
    wet_boxes_run(layer, b->n[0], wet);
    if (wet[1] == 0)
        return;
    const int low = tile_of(b, 0, wet[0]), up = tile_of(b, 0, wet[0] + wet[1] - 1) + 1;
    run[0] = low < run[0] ? low : run[0];
    run[1] = up > run[1] ? up : run[1];
}

/* The run of each tile across, in tiles; ny * nz of them. */
static void find_runs(const struct fv *s, int ny, int (*run)[2])
{
    const struct block *b = &s->b;
    for (int k = 0; k < b->n[2]; k++)
        for (int j = 0; j < b->n[1]; j++)
            look(b, s->surface->layer + block_at(b, 0, j, k),
                 run[tile_of(b, 1, j) + ny * tile_of(b, 2, k)]);
}

/* lo, hi: tiles. */
static void add_box(void *owner, const struct block *b, const int lo[3], const int hi[3],
                    struct wet_boxes *w)
{
    int64_t cells = 1;
    ROOM_IN(owner, w->lo, w->n + 1);
    ROOM_IN(owner, w->hi, w->n + 1);
    for (int a = 0; a < 3; a++) {
        const int from = b->lo[a] / TILE;
        w->lo[w->n][a] = (from + lo[a]) * TILE > b->lo[a] ? (from + lo[a]) * TILE : b->lo[a];
        w->hi[w->n][a] = ((from + hi[a]) * TILE < b->hi[a] ? (from + hi[a]) * TILE : b->hi[a]) - 1;
        cells *= w->hi[w->n][a] - w->lo[w->n][a] + 1;
    }
    w->cells += cells;
    w->n++;
}

static void make_boxes(void *owner, const struct block *b, int ny, int nz, int (*run)[2],
                       struct wet_boxes *w)
{
    w->n = 0;
    w->cells = 0;
    for (int k = 0; k < nz; k++)
        for (int j = 0, end; j < ny; j = end) {
            const int *of = run[j + ny * k];
            for (end = j + 1; end < ny && memcmp(run[end + ny * k], of, sizeof *run) == 0;)
                end++;
            const int lo[3] = {of[0], j, k}, hi[3] = {of[1], end, k + 1};
            if (of[1] > of[0])
                add_box(owner, b, lo, hi, w);
        }
}

/* One box of all cells of the rank. */
static void take_all(void *owner, const struct block *b, struct wet_boxes *w)
{
    static const int none[3] = {0, 0, 0};
    const int all[3] = {tiles_of(b, 0), tiles_of(b, 1), tiles_of(b, 2)};
    w->n = 0;
    w->cells = 0;
    add_box(owner, b, none, all, w);
}

/* Whether some water lies in no box. */
static bool misses_some(const struct fv *s, const struct wet_boxes *w)
{
    const struct block *b = &s->b;
    int64_t all = 0, in = 0;
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            all += s->surface->layer[i] == 0;
    for (int q = 0; q < w->n; q++)
        for (int k = w->lo[q][2]; k <= w->hi[q][2]; k++)
            for (int j = w->lo[q][1]; j <= w->hi[q][1]; j++) {
                const unsigned char *layer =
                    s->surface->layer +
                    block_at(b, w->lo[q][0] - b->lo[0], j - b->lo[1], k - b->lo[2]);
                for (int i = 0; i <= w->hi[q][0] - w->lo[q][0]; i++)
                    in += layer[i] == 0;
            }
    return in < all;
}

/* Collective: boxes are made anew on all ranks if any needs it. Returns whether they are other
 * ones. */
bool wet_boxes_find(const struct fv *s, void *owner, struct wet_boxes *w)
{
    const struct block *b = &s->b;
    const int ny = tiles_of(b, 1), nz = tiles_of(b, 2);
    struct wet_boxes now = {0};
    bool changes = w->n == 0;
    const bool periodic = b->periodic[0] || b->periodic[1] || b->periodic[2];
    if (!s->surface || s->surface->wet == 0 || periodic) {
        if (changes)
            take_all(owner, b, w);
        return changes;
    }
    int(*run)[2] = (int(*)[2])NEW(int, 2 * ny * nz);
    for (int t = 0; t < ny * nz; t++) {
        run[t][0] = INT_MAX;
        run[t][1] = INT_MIN;
    }
    find_runs(s, ny, run);
    make_boxes(owner, b, ny, nz, run, &now);
    changes = ranks_any(s->comm, misses_some(s, w) || w->cells > SPARE * now.cells);
    if (changes) {
        FREE(w->lo, w->hi);
        *w = now;
    } else {
        FREE(now.lo, now.hi);
    }
    mem_free(run);
    return changes;
}
