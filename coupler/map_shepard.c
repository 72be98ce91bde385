/* map_shepard.c - Shepard and moving least squares sums on particles (Chiron 2017, 6.3).
 * Sources lie in cells of edge R, so that a target looks at 3^dim cells; those in reach are summed
 * in the order of their global number. SPDX-License-Identifier: BSD-3-Clause */
#include "map.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "../common/mem.h"

static const double least_weight = 1e-6; /* sum w W below which nothing is there */
static const double worst_condition = 1e6;

static inline double kernel(int dim, double q, double R)
{
    const double c = dim == 2 ? 7.0 / (M_PI * R * R) : 21.0 / (2.0 * M_PI * R * R * R);
    const double a = 1.0 - q, a2 = a * a;
    return q < 1.0 ? c * a2 * a2 * (1.0 + 4.0 * q) : 0.0;
}

double map_kernel(int dim, double r, double R) { return kernel(dim, r / R, R); }

void map_cloud_free(struct map_cloud *c)
{
    mem_free(c->x);
    mem_free(c->gid);
    mem_free(c->volume);
    mem_free(c->v);
    *c = (struct map_cloud){0};
}

/* Sources in cells; within a cell, and overall by `rank', in the order of gid. */
struct cells {
    int n[3];
    double lo[3], edge;
    long *start; /* [ncells + 1] */
    int *member; /* sources by cell: places in the sorted cloud */
};

struct place {
    int64_t gid;
    long i;
};

/* By gid; images of one point by place, and equal numbers too, whatever order they came in. */
static bool before(const struct map_cloud *c, int dim, const struct place *a, const struct place *b)
{
    if (a->gid != b->gid)
        return a->gid < b->gid;
    for (int d = 0; d < dim; d++)
        if (c->x[a->i * dim + d] != c->x[b->i * dim + d])
            return c->x[a->i * dim + d] < c->x[b->i * dim + d];
    return false;
}

/* Merge sort: qsort has no argument for the cloud, and lists of ranks come presorted in pieces. */
static void sort_places(const struct map_cloud *c, int dim, struct place *p, struct place *room,
                        long n)
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

static void *reordered(const void *old, const struct place *p, long n, size_t size)
{
    unsigned char *out = mem_new((size_t)n, size);
    for (long i = 0; i < n; i++)
        memcpy(out + (size_t)i * size, (const unsigned char *)old + (size_t)p[i].i * size, size);
    return out;
}

static void sort_cloud(struct map_cloud *c, int dim, int ncomp)
{
    struct place *p = NEW(struct place, c->n), *room = NEW(struct place, c->n);
    for (long i = 0; i < c->n; i++)
        p[i] = (struct place){.gid = c->gid[i], .i = i};
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

static long cell_of(const struct cells *g, int dim, const double *x)
{
    long cell = 0;
    for (int d = dim - 1; d >= 0; d--) {
        const double s = floor((x[d] - g->lo[d]) / g->edge);
        const long i = s < 0.0 ? 0 : s >= g->n[d] ? g->n[d] - 1 : (long)s;
        cell = cell * g->n[d] + i;
    }
    return cell;
}

/* Cells over the box of the targets and R around it; what lies outside is counted into the
 * outermost cells and found too far there. Edges grow if the box would need more cells than there
 * are points. */
static void make_cells(struct cells *g, int dim, double R, const struct map_cloud *c, long ntarget,
                       const double *x)
{
    double hi[3] = {0}, ncells = 1.0;
    *g = (struct cells){.edge = R, .n = {1, 1, 1}};
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
    g->start = NEW(long, n + 1);
    g->member = NEW(int, c->n);
    for (long i = 0; i < c->n; i++)
        g->start[(cell[i] = cell_of(g, dim, c->x + i * dim)) + 1]++;
    for (long i = 0; i < n; i++)
        g->start[i + 1] += g->start[i];
    for (long i = c->n - 1; i >= 0; i--) /* from behind: start ends up at the first, order kept */
        g->member[--g->start[cell[i] + 1]] = (int)i;
    for (long i = 0; i < n; i++)
        g->start[i] = g->start[i + 1];
    g->start[n] = c->n;
    mem_free(cell);
}

/* Sources of one target in ascending order, with their kernel. */
struct reach {
    int n, capacity, nrun;
    int *j, *room;
    int run[28]; /* starts of ascending runs, one per cell */
};

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

static void gather(struct reach *r, const struct cells *g, int dim, double R,
                   const struct map_cloud *c, const double *x)
{
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
                if (room > r->capacity) {
                    GROW(r->j, r->capacity, 2 * room);
                    GROW(r->room, r->capacity, 2 * room);
                    r->capacity = 2 * room;
                }
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
}

/* a[n][n] -> its inverse (Gauss-Jordan with pivots on the diagonal: a is symmetric positive); the
 * condition number in the 1-norm, INFINITY if singular. */
static double invert(int n, double a[4][4])
{
    double norm = 0.0, inverse = 0.0;
    for (int pass = 0; pass < 2; pass++) {
        for (int k = 0; k < n; k++) {
            double column = 0.0;
            for (int i = 0; i < n; i++)
                column += fabs(a[i][k]);
            if (pass == 0)
                norm = fmax(norm, column);
            else
                inverse = fmax(inverse, column);
        }
        for (int k = 0; k < n && pass == 0; k++) {
            const double p = a[k][k];
            if (!(p > 1e-14 * norm))
                return INFINITY;
            a[k][k] = 1.0;
            for (int j = 0; j < n; j++)
                a[k][j] /= p;
            for (int i = 0; i < n; i++) {
                if (i == k)
                    continue;
                const double f = a[i][k];
                a[i][k] = 0.0;
                for (int j = 0; j < n; j++)
                    a[i][j] -= f * a[k][j];
            }
        }
    }
    return norm * inverse;
}

/* First row of the inverse moment matrix sum w W p p^T / sum w W: the value at the target is row .
 * sum w W p f. False where Shepard must do. */
static bool mls_row(int dim, double R, const struct reach *r, const struct map_cloud *c,
                    const double *x, double row[4])
{
    double a[4][4] = {{0}};
    if (r->n < 2 * (dim + 1))
        return false;
    double total = 0.0;
    for (int k = 0; k < r->n; k++) {
        const long j = r->j[k];
        double p[4] = {1.0}, r2 = 0.0;
        for (int d = 0; d < dim; d++) {
            p[d + 1] = (c->x[j * dim + d] - x[d]) / R;
            r2 += p[d + 1] * p[d + 1];
        }
        const double w = c->volume[j] * kernel(dim, sqrt(r2), R);
        total += w;
        for (int m = 0; m <= dim; m++)
            for (int n = 0; n <= dim; n++)
                a[m][n] += w * p[m] * p[n];
    }
    for (int m = 0; m <= dim; m++)
        for (int n = 0; n <= dim; n++)
            a[m][n] /= total;
    if (!(invert(dim + 1, a) < worst_condition))
        return false;
    for (int m = 0; m <= dim; m++)
        row[m] = a[0][m];
    return true;
}

/* One target; false: nothing there. */
static bool map_one(int dim, double R, int ncomp, bool mls, const struct reach *r,
                    const struct map_cloud *c, const double *x, double *v)
{
    double total = 0.0, row[4] = {1.0};
    for (int a = 0; a < ncomp; a++)
        v[a] = 0.0;
    const bool linear = mls && mls_row(dim, R, r, c, x, row);
    for (int k = 0; k < r->n; k++) {
        const long j = r->j[k];
        double r2 = 0.0, slope = 0.0;
        for (int d = 0; d < dim; d++) {
            const double p = (c->x[j * dim + d] - x[d]) / R;
            r2 += p * p;
            slope += row[d + 1] * p;
        }
        const double w = c->volume[j] * kernel(dim, sqrt(r2), R);
        total += w;
        const double weight = linear ? w * (row[0] + slope) : w;
        for (int a = 0; a < ncomp; a++)
            v[a] += weight * c->v[j * ncomp + a];
    }
    for (int a = 0; a < ncomp; a++)
        v[a] = total < least_weight ? 0.0 : v[a] / total;
    return !(total < least_weight);
}

static void map(int dim, double R, int ncomp, bool mls, struct map_cloud *c, long ntarget,
                const double *x, double *v, unsigned char *mask)
{
    struct cells g;
    struct reach r = {0};
    if (ntarget == 0)
        return;
    sort_cloud(c, dim, ncomp);
    make_cells(&g, dim, R, c, ntarget, x);
    for (long i = 0; i < ntarget; i++) {
        gather(&r, &g, dim, R, c, x + i * dim);
        mask[i] = map_one(dim, R, ncomp, mls, &r, c, x + i * dim, v + i * ncomp);
    }
    mem_free(r.j);
    mem_free(r.room);
    mem_free(g.start);
    mem_free(g.member);
}

void map_shepard(int dim, double R, int ncomp, struct map_cloud *from, long ntarget,
                 const double *x, double *v, unsigned char *mask)
{
    map(dim, R, ncomp, false, from, ntarget, x, v, mask);
}

void map_mls(int dim, double R, int ncomp, struct map_cloud *from, long ntarget, const double *x,
             double *v, unsigned char *mask)
{
    map(dim, R, ncomp, true, from, ntarget, x, v, mask);
}
