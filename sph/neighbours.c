/* neighbours.c - cells, sorting, the list of pairs. Locals are sorted by cell with x fastest, so
 * that the three cells of a row around a particle are one range of indices and the list comes out
 * ascending. Ghosts keep their order (the halo depends on it) and are reached through an index
 * sorted by cell. SPDX-License-Identifier: BSD-3-Clause */
#include "neighbours.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "vec.h"

enum { PRIM = 8 };

struct cells {
    int n[3];
    double lo[3], per_edge;
    int count;         /* cells */
    int *start;        /* [count + 1] of the locals */
    int *ghost_start;  /* [count + 1] */
    int *ghost;        /* ghosts by cell */
    int *cell, *order; /* of each particle; scratch */
    int starts_capacity, particles_capacity;
};

struct neighbours *neighbours_create(void)
{
    struct neighbours *l = NEW(struct neighbours, 1);
    l->scratch = NEW(struct cells, 1);
    return l;
}

void neighbours_free(struct neighbours **l)
{
    if (!*l)
        return;
    struct cells *c = (*l)->scratch;
    mem_free(c->start);
    mem_free(c->ghost_start);
    mem_free(c->ghost);
    mem_free(c->cell);
    mem_free(c->order);
    mem_free(c);
    mem_free((*l)->start);
    mem_free((*l)->count);
    mem_free((*l)->tail);
    mem_free((*l)->j);
    mem_free((*l)->sums);
    mem_free(*l);
    *l = NULL;
}

static int cell_of(const struct cells *c, int dim, const double *x)
{
    int cell = 0;
    for (int a = dim - 1; a >= 0; a--) {
        const double s = (x[a] - c->lo[a]) * c->per_edge;
        const int i = s > 0.0 ? (s < c->n[a] ? (int)s : c->n[a] - 1) : 0;
        cell = cell * c->n[a] + i;
    }
    return cell;
}

static void room(struct cells *c, int particles)
{
    if (c->count + 1 > c->starts_capacity) {
        mem_free(c->start);
        mem_free(c->ghost_start);
        c->starts_capacity = 2 * c->count + 1;
        c->start = NEW(int, c->starts_capacity);
        c->ghost_start = NEW(int, c->starts_capacity);
    }
    if (particles > c->particles_capacity) {
        mem_free(c->cell);
        mem_free(c->order);
        mem_free(c->ghost);
        c->particles_capacity = particles + particles / 4 + 16;
        c->cell = NEW(int, c->particles_capacity);
        c->order = NEW(int, c->particles_capacity);
        c->ghost = NEW(int, c->particles_capacity);
    }
}

/* Cells of edge R + skin or wider (far-flung spray must not cost memory) over the locals, and one
 * more around for the ghosts. */
static void make_cells(struct sph *s, struct cells *c)
{
    double lo[3] = {0, 0, 0}, hi[3] = {0, 0, 0}, edge = s->R + s->skin, cells;
    for (int i = 0; i < s->p.n; i++)
        for (int a = 0; a < s->dim; a++) {
            const double x = s->p.y[(size_t)i * s->p.nstate + a];
            lo[a] = i == 0 || x < lo[a] ? x : lo[a];
            hi[a] = i == 0 || x > hi[a] ? x : hi[a];
        }
    for (;; edge *= 1.26) {
        cells = 1.0;
        for (int a = 0; a < s->dim; a++)
            cells *= floor((hi[a] - lo[a]) / edge) + 3.0;
        if (cells <= 8.0 * s->p.n + 1000.0)
            break;
    }
    c->per_edge = 1.0 / edge;
    c->count = 1;
    for (int a = 0; a < 3; a++) {
        c->n[a] = a < s->dim ? (int)floor((hi[a] - lo[a]) / edge) + 3 : 1;
        c->lo[a] = lo[a] - edge;
        c->count *= c->n[a];
    }
}

/* Counting sort of n things of known cell: start of each cell, order by cell, stable. */
static void sort(int n, const int *cell, int count, int *start, int *order)
{
    memset(start, 0, ((size_t)count + 1) * sizeof *start);
    for (int i = 0; i < n; i++)
        start[cell[i] + 1]++;
    for (int k = 0; k < count; k++)
        start[k + 1] += start[k];
    for (int i = 0; i < n; i++)
        order[start[cell[i]]++] = i;
    memmove(start + 1, start, (size_t)count * sizeof *start);
    start[0] = 0;
}

void neighbours_sort(struct sph *s)
{
    struct cells *c = s->list->scratch;
    make_cells(s, c);
    room(c, s->p.n);
    for (int i = 0; i < s->p.n; i++)
        c->cell[i] = cell_of(c, s->dim, s->p.y + (size_t)i * s->p.nstate);
    sort(s->p.n, c->cell, c->count, c->start, c->order);
    particles_permute(&s->p, s->p.n, c->order);
}

static void sort_ghosts(struct sph *s, struct cells *c)
{
    room(c, s->p.nghost);
    for (int g = 0; g < s->p.nghost; g++)
        c->cell[g] = cell_of(c, s->dim, s->p.prim + (size_t)PRIM * (s->p.n + g));
    sort(s->p.nghost, c->cell, c->count, c->ghost_start, c->ghost);
}

static void rows_room(struct neighbours *l, int n)
{
    if (n <= l->rows_capacity)
        return;
    mem_free(l->start);
    mem_free(l->count);
    mem_free(l->tail);
    l->rows_capacity = n + n / 4 + 16;
    l->start = NEW(int64_t, l->rows_capacity + 1);
    l->count = NEW(int, l->rows_capacity);
    l->tail = NEW(int, l->rows_capacity);
}

/* Ranges of the particles around a cell: rows of three cells. */
struct ranges {
    int n, first[9], last[9];
    int ng, gfirst[9], glast[9];
    int most; /* entries in all */
};

static void find_ranges(const struct cells *c, int dim, const int *at, struct ranges *r)
{
    *r = (struct ranges){0};
    const int x0 = at[0] > 0 ? at[0] - 1 : 0, x1 = at[0] + 1 < c->n[0] ? at[0] + 1 : c->n[0] - 1;
    for (int z = at[2] - (dim == 3); z <= at[2] + (dim == 3); z++)
        for (int y = at[1] - 1; y <= at[1] + 1; y++) {
            if (y < 0 || y >= c->n[1] || z < 0 || z >= c->n[2])
                continue;
            const int row = (z * c->n[1] + y) * c->n[0];
            r->first[r->n] = c->start[row + x0];
            r->last[r->n] = c->start[row + x1 + 1];
            r->most += r->last[r->n] - r->first[r->n];
            r->n++;
            r->gfirst[r->ng] = c->ghost_start[row + x0];
            r->glast[r->ng] = c->ghost_start[row + x1 + 1];
            r->most += r->glast[r->ng] - r->gfirst[r->ng];
            r->ng++;
        }
}

static inline __attribute__((always_inline)) double distance2(const double *x, const double *y,
                                                              const int dim)
{
    const double a = x[0] - y[0], b = x[1] - y[1], c = dim == 3 ? x[2] - y[2] : 0.0;
    return a * a + b * b + c * c;
}

/* Row of particle i: without branches, every candidate is written and the end moves on if it
 * counts. */
static inline __attribute__((always_inline)) int
fill_row(const struct sph *s, const struct cells *c, const struct ranges *r, int i, double reach2,
         int *restrict row, int *tail, const int dim)
{
    const double *restrict prim = s->p.prim, *x = prim + (size_t)PRIM * i;
    int n = 0, before = 0;
    for (int k = 0; k < r->n; k++)
        for (int j = r->first[k]; j < r->last[k]; j++) {
            const int in = distance2(x, prim + (size_t)PRIM * j, dim) < reach2;
            row[n] = j;
            n += in & (j != i);
            before += in & (j < i);
        }
    for (int k = 0; k < r->ng; k++)
        for (int g = r->gfirst[k]; g < r->glast[k]; g++) {
            const int j = s->p.n + c->ghost[g];
            row[n] = j;
            n += distance2(x, prim + (size_t)PRIM * j, dim) < reach2;
        }
    *tail = before;
    return n;
}

static void list_room(struct neighbours *l, int64_t used, int64_t more)
{
    if (used + more <= l->capacity)
        return;
    const int64_t capacity = 2 * (used + more) + 1024;
    GROW(l->j, l->capacity, capacity);
    l->capacity = capacity;
}

static inline __attribute__((always_inline)) void build(struct sph *s, const int dim)
{
    struct neighbours *l = s->list;
    struct cells *c = l->scratch;
    const double reach2 = (s->R + s->skin) * (s->R + s->skin);
    const int dummy = s->p.capacity;
    struct ranges r;
    int64_t used = 0;
    int at[3];
    for (at[2] = 0; at[2] < c->n[2]; at[2]++)
        for (at[1] = 0; at[1] < c->n[1]; at[1]++)
            for (at[0] = 0; at[0] < c->n[0]; at[0]++) {
                const int cell = (at[2] * c->n[1] + at[1]) * c->n[0] + at[0];
                if (c->start[cell] == c->start[cell + 1])
                    continue;
                find_ranges(c, dim, at, &r);
                for (int i = c->start[cell]; i < c->start[cell + 1]; i++) {
                    list_room(l, used, r.most + 2 * LANES);
                    int *row = l->j + used;
                    l->start[i] = used;
                    const int n = l->count[i] =
                        fill_row(s, c, &r, i, reach2, row, l->tail + i, dim);
                    for (int k = n; k < n + 2 * LANES - 1;
                         k++) /* a vector may begin at any entry */
                        row[k] = dummy;
                    used += (n + 2 * LANES - 1) / LANES * LANES;
                }
            }
    l->start[l->n] = used;
}

void neighbours_build(struct sph *s)
{
    struct neighbours *l = s->list;
    l->n = s->p.n;
    rows_room(l, l->n);
    sort_ghosts(s, l->scratch);
    if (s->dim == 2)
        build(s, 2);
    else
        build(s, 3);
}

int64_t neighbours_pairs(const struct sph *s)
{
    const struct neighbours *l = s->list;
    const double R2 = s->R * s->R;
    int64_t n = 0;
    for (int i = 0; i < l->n; i++)
        for (int k = 0; k < l->count[i]; k++)
            n += distance2(s->p.prim + (size_t)PRIM * i,
                           s->p.prim + (size_t)PRIM * l->j[l->start[i] + k], s->dim) < R2;
    return n;
}
