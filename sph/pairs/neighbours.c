/* neighbours.c - cell grid and Verlet list. Locals are stored in the order of the cells, so what a
 * cell finds around it is a few runs; they are copied side by side once a cell, and every particle
 * of the cell filters that copy. Order within a step: neighbours_sort puts locals in the order of
 * the cells; the halo makes ghosts; neighbours_build sorts these by cell (by index, they stay where
 * they are) and writes the rows. Cells have the edge R + skin, so that all neighbours of a particle
 * lie in the 3^dim cells around its own; in x these are contiguous, so there are 3 runs in 2D, 9 in
 * 3D. The work is O(n) as long as cells hold a bounded number of particles.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "neighbours.h"

#include "vec.h"

/* Cells [0, cells) along each axis, the outermost for ghosts only. */
struct list_grid {
    int dim, n;
    double lo[3], edge_1; /* m, 1/m */
    int cells[3];
    int total;
    int *first; /* [total + 1] first local of each cell */
    int *ghost; /* [total + 1] first of each cell in order */
    int *order; /* ghosts by cell */
    int *cell;  /* of each particle that is being sorted */
    /* what lies around one cell */
    int near;
    double *x[3];
    int *id;
};

struct neighbours *neighbours_create(void)
{
    struct neighbours *l = NEW(struct neighbours, 1);
    l->grid = NEW_IN(l, struct list_grid, 1);
    return l;
}

/* The bounding box of this rank's particles from their states; [0, 0] along each axis where there
 * are none or one is not finite. */
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
 * apart, cells grow instead of their number. The bound 64 + 8 n on the number of cells keeps memory
 * and the passes over cells O(n); 1.26 is the cube root of 2, so that every trial halves their
 * number in 3D. Sets the edge, the number of cells along each axis and their total. */
static void lay_grid(struct list_grid *g, const struct sph *s)
{
    double hi[3], edge = (1.0 + 1e-9) * (s->R + s->lists.skin);
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

/* margin 1 for locals, 0 for ghosts. What lies outside goes to the outermost cells; so does NaN. x
 * runs fastest; cell 0 along each axis is outside the locals' box, hence the 1 that is added. */
static int cell_of(const struct list_grid *g, const double *x, int margin)
{
    int cell = 0;
    for (int a = g->dim - 1; a >= 0; a--) {
        const double c = (x[a] - g->lo[a]) * g->edge_1 + 1.0;
        const int last = g->cells[a] - 1 - margin;
        cell = cell * g->cells[a] + (c > margin ? c < last ? (int)c : last : margin);
    }
    return cell;
}

/* Stable counting sort of n rows by cell: first[cell], order. first has total + 1 entries: cell c
 * holds order[first[c]] .. order[first[c + 1] - 1]. */
static void sort_rows(struct list_grid *g, const double *rows, int width, int n, int margin,
                      int *first, int *order)
{
    ROOM_IN(g, g->cell, n);
    memset(first, 0, ((size_t)g->total + 1) * sizeof *first);
    for (int i = 0; i < n; i++) {
        g->cell[i] = cell_of(g, rows + (size_t)i * width, margin);
        first[g->cell[i] + 1]++;
    }
    for (int c = 0; c < g->total; c++)
        first[c + 1] += first[c];
    for (int i = 0; i < n; i++)
        order[first[g->cell[i]]++] = i;
    /* filling has moved each first[c] to the end of its cell, the first of the next one */
    memmove(first + 1, first, (size_t)g->total * sizeof *first);
    first[0] = 0;
}

void neighbours_sort(struct sph *s)
{
    struct list_grid *g = s->list->grid;
    lay_grid(g, s);
    ROOM_IN(g, g->ghost, g->total + 1);
    ROOM_IN(g, g->first, g->total + 1);
    ROOM_IN(g, g->order, s->p.n);
    sort_rows(g, s->p.y, s->p.nstate, s->p.n, 1, g->first, g->order);
    particles_permute(&s->p, s->p.n, g->order, s->guards != NULL);
}

/* Grows the arrays of what lies around a cell to n entries; their contents stay. */
static void near_room(struct list_grid *g, int n)
{
    for (int a = 0; a < 3; a++)
        ROOM_IN(g, g->x[a], n);
    ROOM_IN(g, g->id, n);
}

/* Box of the particles of a cell. */
struct list_box {
    double lo[3], hi[3], reach2;
    int without; /* bits of enum sph_role that leave a particle out */
};

/* The box around the particles that are in a cell now (tighter than the cell itself), against which
 * copy_near filters the surroundings. The cell must not be empty. */
static struct list_box box_of(const struct sph *s, const struct list_grid *g, int cell,
                              double reach)
{
    struct list_box b = {.reach2 = reach * reach};
    for (int a = 0; a < g->dim; a++) {
        b.lo[a] = INFINITY;
        b.hi[a] = -INFINITY;
        for (int i = g->first[cell]; i < g->first[cell + 1]; i++) {
            const double x = prim_line(&s->p, i)[a];
            b.lo[a] = x < b.lo[a] ? x : b.lo[a];
            b.hi[a] = x > b.hi[a] ? x : b.hi[a];
        }
    }
    return b;
}

/* Copies a particle that is within reach of the box: written in any case, counted if so. Without a
 * branch: the next particle overwrites one that was not counted, so there must be room for one
 * more. */
INLINE void copy_near(const struct sph *s, struct list_grid *g, const struct list_box *b, int id,
                      const int dim)
{
    const double *x = prim_line(&s->p, id);
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

/* First cells of the rows of three around `cell'; returns their number. */
static int rows_around(const struct list_grid *g, int cell, int rows[9])
{
    const int nx = g->cells[0], ny = g->cells[1], layers = g->dim == 3 ? 1 : 0;
    int n = 0;
    for (int k = -layers; k <= layers; k++)
        for (int j = -1; j <= 1; j++)
            rows[n++] = cell - 1 + nx * (j + ny * k);
    return n;
}

/* Particles of the cells around `cell': locals in ascending order, then ghosts. The order makes
 * rows of the list begin with lower locals, then higher ones, then ghosts. `most' counts all that
 * the runs hold, before the filter. */
INLINE void look_around(const struct sph *s, struct list_grid *g, int cell, double reach,
                        const int dim)
{
    const struct list_box box = box_of(s, g, cell, reach);
    int rows[9], most = 0;
    const int nrows = rows_around(g, cell, rows);
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
 * to LANES - 1 entries further. least: gets the least square of their distances, or less. */
INLINE int append(const struct list_grid *g, int from, int end, const double *x, double reach2,
                  int *restrict j, vec *least, const int dim)
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
        *least = vec_min(*least, r2);
        unsigned near = vec_less(r2, reach);
        if (end - k < LANES)
            near &= (1u << (end - k)) - 1u;
        n += vec_pack(j + n, id + k, near);
    }
    return (int)n;
}

/* Entries to come after row i, which begins at `at': as many a row as so far, once there are enough
 * of them, and some more. */
static int64_t growth(const struct neighbours *l, int i, int64_t at)
{
    return i <= l->n / 8 ? at / 2 : (int64_t)(1.05 * (double)at / i * (l->n - i)) + at / 32;
}

/* Pairs of row i with j > i closer than that. */
static void add_close(const struct sph *s, int i, double close2)
{
    struct neighbours *l = s->list;
    const double *x = prim_line(&s->p, i);
    for (int k = l->tail[i]; k < l->count[i]; k++) {
        const int j = l->j[l->start[i] + k];
        const double *y = prim_line(&s->p, j);
        const double r2 = vec_distance2(s->dim, y, x);
        if (r2 >= close2)
            continue;
        ROOM_IN(l, l->close, l->nclose + 1);
        l->close[l->nclose][0] = i;
        l->close[l->nclose++][1] = j;
    }
}

/* Writes the rows of all particles of one cell: gathers its surroundings once, then filters them
 * for each particle by the exact distance. The particle itself (position `self' in the gathered
 * ids, which ascend in step with i) splits the row into the part before it and the tail after
 * it. */
INLINE void list_cell(struct sph *s, int cell, const int dim)
{
    struct neighbours *l = s->list;
    struct list_grid *g = l->grid;
    const double reach = s->R + s->lists.skin, reach2 = reach * reach;
    /* 88 % of the points of a full lattice within the reach: with as many neighbours nothing of the
     * support is missing, and surface detection takes the particle as inside without eigenvalues */
    const double enough = 0.88 * (dim == 2 ? M_PI : 4.0 / 3.0 * M_PI) * pow(reach / s->dx, dim);
    /* two that are farther apart now than this cannot come within `touching' before the next
     * list */
    const double close = l->touching > 0.0 ? l->touching + reach - s->R : 0.0;
    const double close2 = close * close;
    const vec within = vec_all(reach2);
    int self = 0;
    look_around(s, g, cell, reach, dim);
    while (g->id[self] != g->first[cell])
        self++;
    for (int i = g->first[cell]; i < g->first[cell + 1]; i++, self++) {
        const int64_t at = l->start[i], most = at + g->near + 2 * LANES;
        if (most > l->capacity) {
            const int64_t more = most + growth(l, i, at);
            GROW_IN(l, l->j, l->capacity, more);
            l->capacity = more;
        }
        const double *x = prim_line(&s->p, i);
        int *j = l->j + at;
        vec spare = within, least = within;
        const int before = append(g, 0, self, x, reach2, j, &spare, dim);
        l->tail[i] = before;
        l->count[i] = before + append(g, self + 1, g->near, x, reach2, j + before, &least, dim);
        l->busy[i] = l->count[i];
        l->whole[i] = l->count[i] + 1 >= enough;
        l->beside[i] = false;
        if (vec_less(least, vec_all(close2)))
            add_close(s, i, close2);
        /* padding: a vector that starts at any entry, the last one included, reads dummies */
        for (int k = 0; k < LANES - 1; k++)
            j[l->count[i] + k] = s->p.capacity;
        l->start[i + 1] = at + l->count[i] + LANES - 1;
    }
}

/* Lists all cells in 2D. dim is a constant in each of the two copies. */
static void build_2d(struct sph *s)
{
    const struct list_grid *g = s->list->grid;
    for (int cell = 0; cell < g->total; cell++)
        if (g->first[cell + 1] > g->first[cell])
            list_cell(s, cell, 2);
}

/* The same in 3D. */
static void build_3d(struct sph *s)
{
    const struct list_grid *g = s->list->grid;
    for (int cell = 0; cell < g->total; cell++)
        if (g->first[cell + 1] > g->first[cell])
            list_cell(s, cell, 3);
}

/* Whether row i has no ghosts: they stand at its end, so the last entry tells. */
static bool is_inner(const struct neighbours *l, int i)
{
    return l->count[i] == 0 || l->j[l->start[i] + l->count[i] - 1] < l->n;
}

/* What a row is: 0 inner, 1 outer, 2 deep. */
static int kind_of(const struct sph *s, int i)
{
    if (s->p.role[i] & ROLE_DEEP)
        return 2;
    return s->run->size > 1 && is_inner(s->list, i) ? 0 : 1;
}

/* Fills `order' with the rows by kind (inner, outer, deep), each kind in the order in which rows
 * are stored; frees it where storage order will do. */
static void order_rows(const struct sph *s, struct neighbours *l)
{
    int n[3] = {0};
    for (int i = 0; i < l->n; i++)
        n[kind_of(s, i)]++;
    l->ninner = n[0];
    l->nshallow = n[0] + n[1];
    if (s->run->size == 1 && n[2] == 0) {
        DROP(l->order);
        return;
    }
    int at[3] = {0, n[0], n[0] + n[1]};
    ROOM_IN(l, l->order, l->n);
    for (int i = 0; i < l->n; i++)
        l->order[at[kind_of(s, i)]++] = i;
}

void neighbours_rows(struct neighbours *l, enum rows which)
{
    l->begin = which == ROWS_OUTER ? l->ninner : 0;
    l->end = which == ROWS_INNER ? l->ninner : l->treated;
    l->first = which != ROWS_OUTER || l->ninner == 0;
    l->last = which != ROWS_INNER; /* no outer rows: an empty part ends the pass */
}

void neighbours_room(struct neighbours *l, int n)
{
    ROOM_IN(l, l->start, n + 1);
    ROOM_IN(l, l->count, n + 1);
    ROOM_IN(l, l->whole, n + 1);
    ROOM_IN(l, l->beside, n + 1);
    ROOM_IN(l, l->tail, n + 1);
}

/* `touching' must have been set before; rows are those of the last neighbours_sort, whose number of
 * locals must still hold. */
void neighbours_build(struct sph *s)
{
    struct neighbours *l = s->list;
    struct list_grid *g = l->grid;
    const int n = s->p.n;
    require(n == g->n); /* neighbours_sort has been here */
    neighbours_room(l, n);
    ROOM_IN(l, l->busy, n + 1);
    l->n = n;
    l->start[0] = 0;
    l->nclose = 0;
    l->spared = false;
    ROOM_IN(g, g->order, s->p.nghost);
    sort_rows(g, prim_line(&s->p, n), PRIM, s->p.nghost, 0, g->ghost, g->order);
    if (s->dim == 2)
        build_2d(s);
    else
        build_3d(s);
    l->nshallow = n;
    if (s->run->size > 1 || s->guards)
        order_rows(s, l);
    l->treated = n;
    neighbours_rows(l, ROWS_ALL);
}

/* The order of those that stay is kept, and so are all sums that are read. */
void neighbours_spare(struct sph *s, const bool *idle)
{
    struct neighbours *l = s->list;
    for (int i = 0; i < l->n; i++) {
        int *j = l->j + l->start[i], busy = l->tail[i];
        for (int k = l->tail[i]; k < l->count[i] && idle[i]; k++)
            if (j[k] < l->n && !idle[j[k]]) {
                const int other = j[k];
                j[k] = j[busy];
                j[busy++] = other;
            }
        if (idle[i])
            l->busy[i] = busy;
    }
    l->spared = true;
}

/* Range of cells along an axis that may hold a place within reach of x: what lies outside is in the
 * outermost ones. */
static void cell_range(const struct list_grid *g, int a, double x, double reach, int *first,
                       int *last)
{
    const int most = g->cells[a] - 1;
    const double lo = (x - reach - g->lo[a]) * g->edge_1 + 1.0;
    const double hi = (x + reach - g->lo[a]) * g->edge_1 + 1.0;
    *first = lo > 0.0 ? lo < most - 1 ? (int)lo : most - 1 : 0;
    *last = hi > 1.0 ? hi < most ? (int)hi : most : 1;
}

/* Of the locals or ghosts of some cells that follow each other. */
INLINE void gather_row(const struct sph *s, struct list_grid *g, const struct list_box *b, int from,
                       int end, const unsigned short *ghost_role, const int dim)
{
    for (int k = from; k < end; k++) {
        const int j = ghost_role ? g->n + g->order[k] : k;
        const int role = ghost_role ? ghost_role[g->order[k]] : s->p.role[k];
        if (!(role & b->without))
            copy_near(s, g, b, j, dim);
    }
}

/* Cells are those of the last sort, from where particles have moved by the skin at most. Gathers
 * around the box b, with `reach' the distance within which cells may hold what is near it at the
 * time of the last sort. */
INLINE void gather(const struct sph *s, const struct list_box *b, double reach,
                   const unsigned short *ghost_role, const int dim)
{
    struct list_grid *g = s->list->grid;
    int first[3] = {0, 0, 0}, last[3] = {0, 0, 0}, unused;
    for (int a = 0; a < dim; a++) {
        cell_range(g, a, b->lo[a], reach, first + a, &unused);
        cell_range(g, a, b->hi[a], reach, &unused, last + a);
    }
    g->near = 0;
    for (int c = first[2]; c <= last[2]; c++)
        for (int r = first[1]; r <= last[1]; r++) {
            const int row = g->cells[0] * (r + g->cells[1] * c);
            const int *own = g->first + row, *ghost = g->ghost + row;
            const int from = first[0], end = last[0] + 1;
            near_room(g, g->near + own[end] - own[from] + ghost[end] - ghost[from] + LANES);
            gather_row(s, g, b, own[from], own[end], NULL, dim);
            gather_row(s, g, b, ghost[from], ghost[end], ghost_role, dim);
        }
}

/* The filter acts with `reach' itself on present positions; only the choice of cells is wider by
 * the skin. */
void neighbours_gather(const struct sph *s, const double *lo, const double *hi, double reach,
                       const unsigned short *ghost_role, int without)
{
    struct list_box b = {.reach2 = reach * reach, .without = without};
    memcpy(b.lo, lo, (size_t)s->dim * sizeof *lo);
    memcpy(b.hi, hi, (size_t)s->dim * sizeof *hi);
    reach += s->lists.skin;
    if (s->dim == 2)
        gather(s, &b, reach, ghost_role, 2);
    else
        gather(s, &b, reach, ghost_role, 3);
}

/* Filters what was gathered by its distance from x, a vector of LANES at a time; the room for 2
 * LANES more is what `append' may write beyond the end. */
int neighbours_pick(const struct sph *s, const double *x, double reach, int n, int **found,
                    void *owner)
{
    const struct list_grid *g = s->list->grid;
    vec least = vec_all(INFINITY);
    ROOM_IN(owner, *found, n + g->near + 2 * LANES);
    return n + (s->dim == 2 ? append(g, 0, g->near, x, reach * reach, *found + n, &least, 2)
                            : append(g, 0, g->near, x, reach * reach, *found + n, &least, 3));
}

/* The records are laid out from the start of s->p.rate, [n + nghost][width], and one for the dummy
 * at s->p.capacity, which takes what padded lanes add. Zeroed only at the first part of a pass. */
double *neighbours_sums(struct sph *s, int width)
{
    double *sums = s->p.rate;
    const size_t used = ((size_t)s->p.n + (size_t)s->p.nghost) * (size_t)width;
    require(width <= s->p.nstate);
    if (s->list->first) {
        memset(sums, 0, used * sizeof(double));
        memset(sums + (size_t)s->p.capacity * (size_t)width, 0, (size_t)width * sizeof(double));
    }
    return sums;
}

/* Counts entries of all rows at present distances, so that each pair of locals counts twice, and
 * one with a ghost once on either rank. */
int64_t neighbours_pairs(const struct sph *s)
{
    const struct neighbours *l = s->list;
    int64_t pairs = 0;
    for (int i = 0; i < l->n; i++) {
        const double *x = prim_line(&s->p, i);
        const int *j = l->j + l->start[i];
        for (int k = 0; k < l->count[i]; k++)
            pairs += vec_distance2(s->dim, x, prim_line(&s->p, j[k])) < s->R * s->R;
    }
    return pairs;
}

/* The tail of each row suffices, since every pair of locals is in one of them. Padding lies at the
 * dummy's position, which must be far away. */
INLINE double least_pair(const struct sph *s, const int dim)
{
    const struct neighbours *l = s->list;
    vec least = vec_all(s->R * s->R);
    for (int i = 0; i < l->n; i++) {
        const double *x = prim_line(&s->p, i);
        const int *j = l->j + l->start[i] + l->tail[i], *end = l->j + l->start[i] + l->count[i];
        for (; j < end; j += LANES) {
            vec d[3], spare, r2;
            vec_columns(s->p.prim, PRIM, j, 0, d, d + 1);
            if (dim == 3)
                vec_columns(s->p.prim, PRIM, j, 2, d + 2, &spare);
            for (int a = 0; a < dim; a++)
                d[a] -= x[a];
            r2 = vec_dot(d, d, dim);
            least = vec_min(least, r2);
        }
    }
    double r2 = least[0];
    for (int k = 1; k < LANES; k++)
        r2 = least[k] < r2 ? least[k] : r2;
    return sqrt(r2);
}

double neighbours_least(const struct sph *s)
{
    return s->dim == 2 ? least_pair(s, 2) : least_pair(s, 3);
}
