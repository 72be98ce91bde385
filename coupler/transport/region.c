/* region.c - which points and cells are wanted: see region.h. The test of a point costs a look at
 * one byte for each of its images, so that a source's rank may test all of its points at every put.
 * Both ends use the same function (region_images), so that what is sent is what is used.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "region.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "wire.h"

enum { MARGIN = 3 };

static const double most_cells = 4e6; /* bytes of a bit map; edges grow beyond */

static int cell_of(const struct region *r, double x)
{
    return (int)fmin(fmax(floor(x / r->edge), -1e9), 1e9);
}

/* Of a cell that is inside. */
static unsigned char *cell_at(const struct region *r, int i, int j, int k)
{
    return r->wanted +
           ((size_t)(k - r->lo[2]) * (size_t)r->n[1] + (size_t)(j - r->lo[1])) * (size_t)r->n[0] +
           (size_t)(i - r->lo[0]);
}

static bool inside(const struct region *r, int i, int j, int k)
{
    return i >= r->lo[0] && j >= r->lo[1] && k >= r->lo[2] && i < r->lo[0] + r->n[0] &&
           j < r->lo[1] + r->n[1] && k < r->lo[2] + r->n[2];
}

/* Sets lo, n and edge so that the bit map holds the box of the targets and `reach' cells around it.
 */
static void fit(struct region *r, double R, long n, const double *x, int reach)
{
    double lo[3] = {0}, hi[3] = {0}, cells;
    for (int d = 0; d < r->dim; d++)
        lo[d] = hi[d] = x[d];
    for (long i = 1; i < n; i++)
        for (int d = 0; d < r->dim; d++) {
            lo[d] = fmin(lo[d], x[i * r->dim + d]);
            hi[d] = fmax(hi[d], x[i * r->dim + d]);
        }
    for (r->edge = R;; r->edge *= 2.0) {
        cells = 1.0;
        for (int d = 0; d < r->dim; d++)
            cells *= (hi[d] - lo[d]) / r->edge + 2.0 * reach + 1.0;
        if (cells < most_cells)
            break;
    }
    for (int d = 0; d < 3; d++) {
        r->lo[d] = d < r->dim ? cell_of(r, lo[d]) - reach : 0;
        r->n[d] = d < r->dim ? cell_of(r, hi[d]) + reach + 1 - r->lo[d] : 1;
    }
}

/* A source within R of a target lies in the target's cell or in one next to it, the edge being R or
 * more: reach is 1 cell, and `slack' more. */
struct region region_around(int dim, double R, const double period[3], long n, const double *x,
                            int slack)
{
    struct region r = {.dim = dim, .edge = R, .n = {0, 0, 0}};
    const int reach = 1 + slack;
    memcpy(r.period, period, sizeof r.period);
    if (n == 0)
        return r;
    fit(&r, R, n, x, reach);
    r.wanted = wire_alloc((size_t)r.n[0] * (size_t)r.n[1] * (size_t)r.n[2]);
    memset(r.wanted, 0, (size_t)r.n[0] * (size_t)r.n[1] * (size_t)r.n[2]);
    const int reach_z = dim == 3 ? reach : 0;
    for (long t = 0; t < n; t++) {
        const double *y = x + t * dim;
        const int i = cell_of(&r, y[0]), j = cell_of(&r, y[1]);
        const int k = dim == 3 ? cell_of(&r, y[2]) : 0;
        for (int c = k - reach_z; c <= k + reach_z; c++)
            for (int b = j - reach; b <= j + reach; b++)
                memset(cell_at(&r, i - reach, b, c), 1, 2 * (size_t)reach + 1);
    }
    return r;
}

/* Boxes may be as large as a caller likes, INFINITY too. */
static int index_of(double x, double origin, double spacing)
{
    return (int)fmin(fmax(floor((x - origin) / spacing), -5e8), 5e8);
}

/* MARGIN: a cubic stencil reaches two cells from a place, the averages' second difference one
 * more. */
void region_cells(int dim, const double origin[3], const double spacing[3], const int cells[3],
                  const int periodic[3], const double lo[3], const double hi[3], int first[3],
                  int last[3])
{
    for (int a = 0; a < 3; a++) {
        first[a] = 0;
        last[a] = a < dim ? cells[a] : 1;
    }
    for (int a = 0; a < dim; a++) {
        if (!(lo[a] <= hi[a])) {
            first[0] = last[0] = 0;
            return;
        }
        const int i = index_of(lo[a], origin[a], spacing[a]) - MARGIN;
        const int j = index_of(hi[a], origin[a], spacing[a]) + MARGIN + 1;
        if (periodic[a]) { /* more than once round tells nothing new */
            const int round = cells[a] + 2 * MARGIN + 1;
            first[a] = i;
            last[a] = j - i > round ? i + round : j;
        } else {
            /* a box outside the grid still has a nearest place: the outermost cells */
            first[a] = i < 0 ? 0 : i > cells[a] - MARGIN - 1 ? cells[a] - MARGIN - 1 : i;
            first[a] = first[a] < 0 ? 0 : first[a];
            last[a] = j > cells[a] ? cells[a] : j < MARGIN + 1 ? MARGIN + 1 : j;
            last[a] = last[a] > cells[a] ? cells[a] : last[a];
        }
    }
}

static bool boxes_hold(const struct region *a, const struct region_box *b)
{
    for (int d = 0; d < 3; d++)
        if (b->lo[d] >= b->hi[d])
            return true;
    for (int i = 0; i < a->nboxes; i++) {
        const struct region_box *o = &a->box[i];
        if (o->asker == b->asker && o->lo[0] <= b->lo[0] && o->lo[1] <= b->lo[1] &&
            o->lo[2] <= b->lo[2] && o->hi[0] >= b->hi[0] && o->hi[1] >= b->hi[1] &&
            o->hi[2] >= b->hi[2])
            return true;
    }
    return false;
}

/* Bit maps of other edges are not compared: a new one is sent. */
bool region_holds(const struct region *a, const struct region *b)
{
    if (a->all || b->all)
        return a->all;
    for (int i = 0; i < b->nboxes; i++)
        if (!boxes_hold(a, &b->box[i]))
            return false;
    if (!b->wanted)
        return true;
    if (!a->wanted || a->edge != b->edge)
        return false;
    for (int k = b->lo[2]; k < b->lo[2] + b->n[2]; k++)
        for (int j = b->lo[1]; j < b->lo[1] + b->n[1]; j++)
            for (int i = b->lo[0]; i < b->lo[0] + b->n[0]; i++)
                if (*cell_at(b, i, j, k) && !(inside(a, i, j, k) && *cell_at(a, i, j, k)))
                    return false;
    return true;
}

/* One period to each side, which is enough for points and targets of one period and R less than
 * it. */
int region_images(const struct region *r, const double *x, double image[27][3])
{
    int n = 0, shift[3], most[3];
    if (r->all && image)
        memcpy(image[0], x, sizeof image[0]);
    if (r->all || !r->wanted)
        return r->all;
    for (int d = 0; d < 3; d++)
        most[d] = d < r->dim && r->period[d] > 0.0;
    for (shift[2] = -most[2]; shift[2] <= most[2]; shift[2]++)
        for (shift[1] = -most[1]; shift[1] <= most[1]; shift[1]++)
            for (shift[0] = -most[0]; shift[0] <= most[0]; shift[0]++) {
                int c[3] = {0, 0, 0};
                double y[3] = {0};
                for (int d = 0; d < r->dim; d++) {
                    y[d] = x[d] + shift[d] * r->period[d];
                    c[d] = cell_of(r, y[d]);
                }
                if (!inside(r, c[0], c[1], c[2]) || !*cell_at(r, c[0], c[1], c[2]))
                    continue;
                if (!image)
                    return 1;
                memcpy(image[n++], y, sizeof y);
            }
    return n;
}

/* Both ends are of one version, so the struct goes as it is, without its pointers. */
void region_pack(struct pack *p, const struct region *r)
{
    struct region flat = *r;
    flat.wanted = NULL;
    flat.box = NULL;
    pack_bytes(p, &flat, sizeof flat);
    pack_bytes(p, r->box, (size_t)r->nboxes * sizeof *r->box);
    pack_int(p, r->wanted != NULL);
    if (r->wanted)
        pack_bytes(p, r->wanted, (size_t)r->n[0] * (size_t)r->n[1] * (size_t)r->n[2]);
}

struct region region_take(struct wire *w, struct message *m)
{
    struct region r;
    take_bytes(w, m, &r, sizeof r);
    r.box = NULL;
    r.wanted = NULL;
    if (r.nboxes > 0) {
        r.box = wire_alloc((size_t)r.nboxes * sizeof *r.box);
        take_bytes(w, m, r.box, (size_t)r.nboxes * sizeof *r.box);
    }
    if (take_int(w, m)) {
        const size_t n = (size_t)r.n[0] * (size_t)r.n[1] * (size_t)r.n[2];
        r.wanted = wire_alloc(n);
        take_bytes(w, m, r.wanted, n);
    }
    return r;
}

void region_free(struct region *r)
{
    free(r->wanted);
    free(r->box);
    *r = (struct region){0};
}
