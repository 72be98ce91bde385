/* neighbours.c - cell grid and Verlet list. Locals are stored in the order of the cells, so what a
 * cell finds around it is a few runs; they are copied side by side once a cell, and every particle
 * of the cell filters that copy. SPDX-License-Identifier: BSD-3-Clause */
#include "neighbours.h"

#include <math.h>
#include <string.h>

#include "../common/log.h"
#include "../common/mem.h"
#include "vec.h"

enum { PRIM = 8 };

/* Cells [0, cells) along each axis, the outermost for ghosts only. */
struct grid {
    int dim, n;
    double lo[3], edge_1; /* m, 1/m */
    int cells[3];
    int total;
    int *first; /* [total + 1] first local of each cell */
    int *ghost; /* [total + 1] first of each cell in order */
    int *order; /* ghosts by cell */
    int first_capacity, order_capacity;
    int *cell; /* of each particle that is being sorted */
    int cell_capacity;
    /* what lies around one cell */
    int near, near_capacity;
    double *x[3];
    int *id;
};

struct neighbours *neighbours_create(void)
{
    struct neighbours *l = NEW(struct neighbours, 1);
    l->grid = NEW(struct grid, 1);
    return l;
}

void neighbours_free(struct neighbours **l)
{
    if (!*l)
        return;
    struct grid *g = (*l)->grid;
    mem_free(g->first);
    mem_free(g->ghost);
    mem_free(g->order);
    mem_free(g->cell);
    for (int a = 0; a < 3; a++)
        mem_free(g->x[a]);
    mem_free(g->id);
    mem_free(g);
    mem_free((*l)->start);
    mem_free((*l)->count);
    mem_free((*l)->tail);
    mem_free((*l)->order);
    mem_free((*l)->j);
    mem_free((*l)->sums);
    mem_free(*l);
    *l = NULL;
}

/* Grows an array whose contents do not matter. */
#define ROOM(p, capacity, wanted)                                                                  \
    do {                                                                                           \
        if ((wanted) > (capacity)) {                                                               \
            mem_free(p);                                                                           \
            (capacity) = (wanted) + (wanted) / 4 + 64;                                             \
            (p) = mem_new((size_t)(capacity), sizeof *(p));                                        \
        }                                                                                          \
    } while (0)

static void bound_locals(const struct sph *s, double lo[3], double hi[3])
{
    for (int a = 0; a < s->dim; a++) {
        lo[a] = INFINITY;
        hi[a] = -INFINITY;
        for (int i = 0; i < s->p.n; i++) {
            const double x = s->p.y[(size_t)i * s->p.nstate + a];
            lo[a] = x < lo[a] ? x : lo[a];
            hi[a] = x > hi[a] ? x : hi[a];
        }
        if (!(fabs(hi[a] - lo[a]) < INFINITY)) /* none, or none that is finite */
            lo[a] = hi[a] = 0.0;
    }
}

/* Box of the locals in cells of the reach, with one layer more for ghosts. Should particles fly
 * apart, cells grow instead of their number. */
static void lay_grid(struct grid *g, const struct sph *s)
{
    double hi[3], edge = (1.0 + 1e-9) * (s->R + s->skin);
    const double most = 64.0 + 8.0 * s->p.n;
    g->dim = s->dim;
    g->n = s->p.n;
    bound_locals(s, g->lo, hi);
    for (;; edge *= 1.26) {
        double total = 1.0;
        for (int a = 0; a < s->dim; a++)
            total *= floor((hi[a] - g->lo[a]) / edge) + 3.0;
        if (total <= most)
            break;
    }
    g->edge_1 = 1.0 / edge;
    g->total = 1;
    for (int a = 0; a < 3; a++) {
        g->cells[a] = a < s->dim ? (int)floor((hi[a] - g->lo[a]) / edge) + 3 : 1;
        g->total *= g->cells[a];
    }
}

/* margin 1 for locals, 0 for ghosts. What lies outside goes to the outermost cells; so does NaN. */
static int cell_of(const struct grid *g, const double *x, int margin)
{
    int cell = 0;
    for (int a = g->dim - 1; a >= 0; a--) {
        const double c = (x[a] - g->lo[a]) * g->edge_1 + 1.0;
        const int last = g->cells[a] - 1 - margin;
        cell = cell * g->cells[a] + (c > margin ? c < last ? (int)c : last : margin);
    }
    return cell;
}

/* Stable counting sort of n rows by cell: first[cell], order. */
static void sort_rows(struct grid *g, const double *rows, int width, int n, int margin, int *first,
                      int *order)
{
    ROOM(g->cell, g->cell_capacity, n);
    memset(first, 0, ((size_t)g->total + 1) * sizeof *first);
    for (int i = 0; i < n; i++) {
        g->cell[i] = cell_of(g, rows + (size_t)i * width, margin);
        first[g->cell[i] + 1]++;
    }
    for (int c = 0; c < g->total; c++)
        first[c + 1] += first[c];
    for (int i = 0; i < n; i++)
        order[first[g->cell[i]]++] = i;
    memmove(first + 1, first, (size_t)g->total * sizeof *first);
    first[0] = 0;
}

void neighbours_sort(struct sph *s)
{
    struct grid *g = s->list->grid;
    lay_grid(g, s);
    int ghost_capacity = g->first_capacity;
    ROOM(g->ghost, ghost_capacity, g->total + 1);
    ROOM(g->first, g->first_capacity, g->total + 1);
    ROOM(g->order, g->order_capacity, s->p.n);
    sort_rows(g, s->p.y, s->p.nstate, s->p.n, 1, g->first, g->order);
    particles_permute(&s->p, s->p.n, g->order);
}

static void near_room(struct grid *g, int n)
{
    if (n <= g->near_capacity)
        return;
    int capacity = 0;
    for (int a = 0; a < 3; a++) {
        capacity = 0;
        ROOM(g->x[a], capacity, n);
    }
    capacity = 0;
    ROOM(g->id, capacity, n);
    g->near_capacity = capacity;
}

/* Box of the particles of a cell. */
struct box {
    double lo[3], hi[3], reach2;
};

static struct box box_of(const struct sph *s, const struct grid *g, int cell)
{
    struct box b = {.reach2 = (s->R + s->skin) * (s->R + s->skin)};
    for (int a = 0; a < g->dim; a++) {
        b.lo[a] = INFINITY;
        b.hi[a] = -INFINITY;
        for (int i = g->first[cell]; i < g->first[cell + 1]; i++) {
            const double x = s->p.prim[(ptrdiff_t)PRIM * i + a];
            b.lo[a] = x < b.lo[a] ? x : b.lo[a];
            b.hi[a] = x > b.hi[a] ? x : b.hi[a];
        }
    }
    return b;
}

/* Copies a particle that is within reach of the box: written in any case, counted if so. */
INLINE void copy_near(const struct sph *s, struct grid *g, const struct box *b, int id,
                      const int dim)
{
    const double *x = s->p.prim + (ptrdiff_t)PRIM * id;
    double r2 = 0.0;
    for (int a = 0; a < dim; a++) {
        const double below = b->lo[a] - x[a], above = x[a] - b->hi[a];
        const double out = below > above ? below : above;
        r2 += out > 0.0 ? out * out : 0.0;
        g->x[a][g->near] = x[a];
    }
    g->id[g->near] = id;
    g->near += r2 < b->reach2;
}

/* Particles of the cells around `cell': locals in ascending order, then ghosts. */
INLINE void look_around(const struct sph *s, struct grid *g, int cell, const int dim)
{
    const struct box box = box_of(s, g, cell);
    const int nx = g->cells[0], ny = g->cells[1], layers = dim == 3 ? 1 : 0;
    int rows[9], nrows = 0, most = 0;
    for (int k = -layers; k <= layers; k++)
        for (int j = -1; j <= 1; j++)
            rows[nrows++] = cell - 1 + nx * (j + ny * k);
    for (int k = 0; k < nrows; k++)
        most +=
            g->first[rows[k] + 3] - g->first[rows[k]] + g->ghost[rows[k] + 3] - g->ghost[rows[k]];
    near_room(g, most + LANES);
    g->near = 0;
    for (int k = 0; k < nrows; k++)
        for (int i = g->first[rows[k]]; i < g->first[rows[k] + 3]; i++)
            copy_near(s, g, &box, i, dim);
    for (int k = 0; k < nrows; k++)
        for (int i = g->ghost[rows[k]]; i < g->ghost[rows[k] + 3]; i++)
            copy_near(s, g, &box, g->n + g->order[i], dim);
}

/* Appends those of the surroundings from .. end-1 that are within reach of x; may look and write up
 * to LANES - 1 entries further. */
INLINE int append(const struct grid *g, int from, int end, const double *x, double reach2,
                  int *restrict j, const int dim)
{
    typedef double near_vec __attribute__((vector_size(8 * LANES), aligned(8), may_alias));
    const double *X = g->x[0], *Y = g->x[1], *Z = g->x[2];
    const int *id = g->id;
    const vec x0 = vec_all(x[0]), x1 = vec_all(x[1]), x2 = vec_all(dim == 3 ? x[2] : 0.0);
    const vec reach = vec_all(reach2);
    ptrdiff_t n = 0;
    for (ptrdiff_t k = from; k < end; k += LANES) {
        const vec a = *(const near_vec *)(X + k) - x0, b = *(const near_vec *)(Y + k) - x1;
        vec r2 = a * a + b * b;
        if (dim == 3) {
            const vec c = *(const near_vec *)(Z + k) - x2;
            r2 += c * c;
        }
        unsigned near = vec_less(r2, reach);
        if (end - k < LANES)
            near &= (1u << (end - k)) - 1u;
        n += vec_pack(j + n, id + k, near);
    }
    return (int)n;
}

INLINE void list_cell(struct sph *s, int cell, const int dim)
{
    struct neighbours *l = s->list;
    struct grid *g = l->grid;
    const double reach2 = (s->R + s->skin) * (s->R + s->skin);
    int self = 0;
    look_around(s, g, cell, dim);
    while (g->id[self] != g->first[cell])
        self++;
    for (int i = g->first[cell]; i < g->first[cell + 1]; i++, self++) {
        const int64_t at = l->start[i], most = at + g->near + 2 * LANES;
        if (most > l->capacity) {
            const int64_t more = most + most / 2;
            GROW(l->j, l->capacity, more);
            l->capacity = more;
        }
        const double *x = s->p.prim + (ptrdiff_t)PRIM * i;
        int *j = l->j + at;
        const int before = append(g, 0, self, x, reach2, j, dim);
        l->tail[i] = before;
        l->count[i] = before + append(g, self + 1, g->near, x, reach2, j + before, dim);
        for (int k = 0; k < LANES - 1; k++)
            j[l->count[i] + k] = s->p.capacity;
        l->start[i + 1] = at + l->count[i] + LANES - 1;
    }
}

static void build_2d(struct sph *s)
{
    const struct grid *g = s->list->grid;
    for (int cell = 0; cell < g->total; cell++)
        if (g->first[cell + 1] > g->first[cell])
            list_cell(s, cell, 2);
}

static void build_3d(struct sph *s)
{
    const struct grid *g = s->list->grid;
    for (int cell = 0; cell < g->total; cell++)
        if (g->first[cell + 1] > g->first[cell])
            list_cell(s, cell, 3);
}

/* Ghosts stand at the end of a row. */
static bool is_inner(const struct neighbours *l, int i)
{
    return l->count[i] == 0 || l->j[l->start[i] + l->count[i] - 1] < l->n;
}

static void order_rows(struct neighbours *l, bool alone)
{
    int outer = 0;
    l->ninner = 0;
    for (int i = 0; i < l->n && !alone; i++)
        l->ninner += is_inner(l, i);
    for (int i = 0, inner = 0; i < l->n; i++)
        if (!alone && is_inner(l, i))
            l->order[inner++] = i;
        else
            l->order[l->ninner + outer++] = i;
    neighbours_rows(l, ROWS_ALL);
}

void neighbours_rows(struct neighbours *l, enum rows which)
{
    l->begin = which == ROWS_OUTER ? l->ninner : 0;
    l->end = which == ROWS_INNER ? l->ninner : l->n;
}

void neighbours_build(struct sph *s)
{
    struct neighbours *l = s->list;
    struct grid *g = l->grid;
    const int n = s->p.n;
    require(n == g->n); /* neighbours_sort has been here */
    if (n + 1 > l->rows_capacity) {
        int capacity = l->rows_capacity;
        ROOM(l->start, capacity, n + 1);
        capacity = l->rows_capacity;
        ROOM(l->count, capacity, n + 1);
        capacity = l->rows_capacity;
        ROOM(l->order, capacity, n + 1);
        ROOM(l->tail, l->rows_capacity, n + 1);
    }
    l->n = n;
    l->start[0] = 0;
    ROOM(g->order, g->order_capacity, s->p.nghost);
    sort_rows(g, s->p.prim + (ptrdiff_t)PRIM * n, PRIM, s->p.nghost, 0, g->ghost, g->order);
    if (s->dim == 2)
        build_2d(s);
    else
        build_3d(s);
    order_rows(l, s->run->size < 2);
}

double *neighbours_sums(struct sph *s, int width)
{
    struct neighbours *l = s->list;
    const size_t used = ((size_t)s->p.n + (size_t)s->p.nghost) * (size_t)width;
    const size_t all = ((size_t)s->p.capacity + 1) * (size_t)width;
    if (all > l->sums_capacity) {
        mem_free(l->sums);
        l->sums = NEW(double, all);
        l->sums_capacity = all;
    }
    if (l->begin == 0) {
        memset(l->sums, 0, used * sizeof(double));
        memset(l->sums + all - width, 0, (size_t)width * sizeof(double));
    }
    return l->sums;
}

int64_t neighbours_pairs(const struct sph *s)
{
    const struct neighbours *l = s->list;
    int64_t pairs = 0;
    for (int i = 0; i < l->n; i++) {
        const double *x = s->p.prim + (ptrdiff_t)PRIM * i;
        const int *j = l->j + l->start[i];
        for (int k = 0; k < l->count[i]; k++) {
            const double *xj = s->p.prim + (ptrdiff_t)PRIM * j[k];
            double r2 = 0.0;
            for (int a = 0; a < s->dim; a++)
                r2 += (x[a] - xj[a]) * (x[a] - xj[a]);
            pairs += r2 < s->R * s->R;
        }
    }
    return pairs;
}
