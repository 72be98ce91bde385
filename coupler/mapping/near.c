/* near.c - sources in cells of edge R, so that a place looks at 3^dim cells; those in reach come in
 * the order of their global number. SPDX-License-Identifier: BSD-3-Clause */
#include "near.h"

#include <limits.h>

#include "../../common/base/base.h"

void map_cloud_free(struct map_cloud *c)
{
    FREE(c->x, c->gid, c->volume, c->v);
    *c = (struct map_cloud){0};
}

/* n: points in all, after it. */
void map_cloud_room(struct map_cloud *c, int dim, long ncomp, long n)
{
    ROOM_IN(NULL, c->x, n * dim);
    ROOM_IN(NULL, c->gid, n);
    ROOM_IN(NULL, c->volume, n);
    ROOM_IN(NULL, c->v, n * ncomp);
}

struct near_place {
    int64_t gid;
    long i;
};

/* By gid; images of one point by place, and equal numbers too, whatever order they came in. */
static bool before(const struct map_cloud *c, int dim, const struct near_place *a,
                   const struct near_place *b)
{
    if (a->gid != b->gid)
        return a->gid < b->gid;
    for (int d = 0; d < dim; d++)
        if (c->x[a->i * dim + d] != c->x[b->i * dim + d])
            return c->x[a->i * dim + d] < c->x[b->i * dim + d];
    return false;
}

/* Merge sort: qsort has no argument for the cloud, and lists of ranks come presorted in pieces. O(n
 * log n). */
static void sort_places(const struct map_cloud *c, int dim, struct near_place *p,
                        struct near_place *room, long n)
{
    for (long width = 1; width < n; width *= 2) {
        for (long lo = 0; lo < n; lo += 2 * width) {
            const long mid = lo + width < n ? lo + width : n,
                       hi = mid + width < n ? mid + width : n;
            long i = lo, j = mid;
            for (long k = lo; k < hi; k++)
                room[k] = i < mid && (j == hi || !before(c, dim, &p[j], &p[i])) ? p[i++] : p[j++];
        }
        memcpy(p, room, (size_t)n * sizeof *p);
    }
}

static void *reordered(const void *old, const struct near_place *p, long n, size_t size)
{
    unsigned char *out = mem_new((size_t)n, size);
    for (long i = 0; i < n; i++)
        memcpy(out + (size_t)i * size, (const unsigned char *)old + (size_t)p[i].i * size, size);
    return out;
}

/* The order of sums is then the same on any number of ranks. */
void near_sort(struct map_cloud *c, int dim, int ncomp)
{
    struct near_place *p = NEW(struct near_place, c->n), *room = NEW(struct near_place, c->n);
    for (long i = 0; i < c->n; i++)
        p[i] = (struct near_place){.gid = c->gid[i], .i = i};
    sort_places(c, dim, p, room, c->n);
    mem_free(room);
    struct map_cloud s = {.n = c->n,
                          .x = reordered(c->x, p, c->n, (size_t)dim * sizeof(double)),
                          .gid = reordered(c->gid, p, c->n, sizeof(int64_t)),
                          .volume = reordered(c->volume, p, c->n, sizeof(double)),
                          .v = reordered(c->v, p, c->n, (size_t)ncomp * sizeof(double))};
    map_cloud_free(c);
    *c = s;
    mem_free(p);
}

/* Places outside go to the outermost cells. */
static long cell_of(const struct near *g, const double *x)
{
    long cell = 0;
    for (int d = g->dim - 1; d >= 0; d--) {
        const double s = floor((x[d] - g->lo[d]) / g->edge);
        const long i = s < 0.0 ? 0 : s >= g->n[d] ? g->n[d] - 1 : (long)s;
        cell = cell * g->n[d] + i;
    }
    return cell;
}

/* Cells over the box of the targets and R around it; what lies outside is counted into the
 * outermost cells and found too far there. Edges grow if the box would need more cells than there
 * are points. Counting sort of the sources into cells. */
static void make_cells(struct near *g, long ntarget, const double *x)
{
    const struct map_cloud *c = g->cloud;
    const int dim = g->dim;
    const double R = g->R;
    double hi[3] = {0}, ncells = 1.0;
    if (c->n > INT_MAX / 2)
        abort_run("%ld points around the targets of one rank of the coupler: give it more ranks",
                  c->n);
    for (int d = 0; d < dim; d++) {
        g->lo[d] = hi[d] = x[d];
        for (long i = 1; i < ntarget; i++) {
            g->lo[d] = fmin(g->lo[d], x[i * dim + d]);
            hi[d] = fmax(hi[d], x[i * dim + d]);
        }
        g->lo[d] -= R;
        hi[d] += R;
    }
    const double limit = 8.0 * (double)(c->n + ntarget) + 1000.0;
    for (;; g->edge *= 1.5) {
        ncells = 1.0;
        for (int d = 0; d < dim; d++)
            ncells *= floor((hi[d] - g->lo[d]) / g->edge) + 1.0;
        if (ncells <= limit)
            break;
    }
    for (int d = 0; d < dim; d++)
        g->n[d] = (int)floor((hi[d] - g->lo[d]) / g->edge) + 1;
    const long n = (long)g->n[0] * g->n[1] * g->n[2];
    long *cell = NEW(long, c->n);
    g->start = NEW_IN(g, long, n + 1);
    g->member = NEW_IN(g, int, c->n);
    for (long i = 0; i < c->n; i++)
        g->start[(cell[i] = cell_of(g, c->x + i * dim)) + 1]++;
    for (long i = 0; i < n; i++)
        g->start[i + 1] += g->start[i];
    for (long i = c->n - 1; i >= 0; i--) /* from behind: start ends up at the first, order kept */
        g->member[--g->start[cell[i] + 1]] = (int)i;
    for (long i = 0; i < n; i++)
        g->start[i] = g->start[i + 1];
    g->start[n] = c->n;
    mem_free(cell);
}

struct near *near_create(int dim, double R, const struct map_cloud *c, long n, const double *x)
{
    struct near *g = NEW(struct near, 1);
    *g = (struct near){.dim = dim, .R = R, .edge = R, .cloud = c, .n = {1, 1, 1}};
    make_cells(g, n, x);
    return g;
}

/* Pairs of runs into one until one is left: n log(3^dim) comparisons. */
static void merge_runs(struct reach *r)
{
    r->run[r->nrun] = r->n;
    while (r->nrun > 1) {
        int out = 0, runs = 0;
        for (int k = 0; k < r->nrun; k += 2) {
            int a = r->run[k];
            const int mid = r->run[k + 1];
            int b = mid;
            const int end = k + 2 <= r->nrun ? r->run[k + 2] : mid;
            const int begin = out;
            while (a < mid || b < end)
                r->room[out++] = a < mid && (b >= end || r->j[a] < r->j[b]) ? r->j[a++] : r->j[b++];
            r->run[runs++] = begin;
        }
        r->run[runs] = out;
        r->nrun = runs;
        int *const swap = r->j;
        r->j = r->room;
        r->room = swap;
    }
}

/* Looks at the 3^dim cells around x. Each cell's members are in order (a run); the runs are merged,
 * so that the sum that follows has one order, whatever the cells. */
const struct reach *near_gather(struct near *g, const double *x)
{
    const struct map_cloud *c = g->cloud;
    struct reach *r = &g->reach;
    const int dim = g->dim;
    const double R = g->R;
    int at[3] = {0, 0, 0}, first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
    for (int d = 0; d < dim; d++) {
        at[d] = (int)floor((x[d] - g->lo[d]) / g->edge);
        first[d] = at[d] > 0 ? at[d] - 1 : 0;
        last[d] = at[d] + 1 < g->n[d] ? at[d] + 1 : g->n[d] - 1;
    }
    r->n = r->nrun = 0;
    for (int k = first[2]; k <= last[2]; k++)
        for (int j = first[1]; j <= last[1]; j++)
            for (int i = first[0]; i <= last[0]; i++) {
                const long cell = ((long)k * g->n[1] + j) * g->n[0] + i;
                const int begin = r->n, room = r->n + (int)(g->start[cell + 1] - g->start[cell]);
                ROOM_IN(g, r->j, room);
                ROOM_IN(g, r->room, room);
                for (long m = g->start[cell]; m < g->start[cell + 1]; m++) {
                    const double *y = c->x + (long)g->member[m] * dim;
                    double r2 = 0.0;
                    for (int d = 0; d < dim; d++)
                        r2 += (y[d] - x[d]) * (y[d] - x[d]);
                    if (r2 < R * R)
                        r->j[r->n++] = g->member[m];
                }
                if (r->n > begin)
                    r->run[r->nrun++] = begin;
            }
    merge_runs(r);
    return r;
}

void near_map(near_one *one, int dim, double R, int ncomp, struct map_cloud *from, long ntarget,
              const double *x, double *v, unsigned char *mask)
{
    if (ntarget == 0)
        return;
    near_sort(from, dim, ncomp);
    struct near *g = near_create(dim, R, from, ntarget, x);
    for (long i = 0; i < ntarget; i++)
        mask[i] = one(dim, R, ncomp, near_gather(g, x + i * dim), from, x + i * dim, v + i * ncomp);
    mem_free(g);
}
