/* halving.c - see halving.h. Each level halves the cells along one axis, that of the least spacing;
 * axes of like spacing go together, and the grids between are not relaxed. Coarse grids are
 * networks of conductances again: across a face of two cells that are twice as far apart half of
 * it, side by side the sum. Interpolation is linear, as 0 in air, and mirrored at sides; the
 * restriction its transpose. Relaxation: two steps of Richardson's iteration, Chebyshev's for the
 * waves that the coarser grid has not, which keep no order of cells: ranks make no difference.
 * The ranks share the finest grid; all have all of the coarser ones.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "halving.h"

enum {
    MARGIN = 2, /* ghosts of coarse grids: what the transfers reach */
    MOST_LEVELS = 64
};

/* One grid. Fields are 0 where no row is. */
struct halved {
    int n[3], lo[3], all[3]; /* cells here, where they begin, those of all ranks */
    int g[3];
    int64_t stride[3], size;
    double h[3];        /* m: spacings, about */
    int axis;           /* along which the next level has half the cells; < 0: this is the last */
    bool relaxes;       /* else it is a step between two that do */
    double share[2];    /* of its two steps */
    double *through[3]; /* 1/m^2: what the lower face of each cell passes */
    double *own;        /* 1/m^2: on the diagonal beside the faces */
    double *diagonal, *per; /* 1/m^2, m^2: 1 over it, 0 where no row is */
    double *x, *y, *b;
    int (*run)[2];
    int used[3][2]; /* along y and z: first line that has rows, and the one behind the last */
};

struct halving {
    const struct block *block; /* borrowed */
    int dim, n, ranks;
    struct halved level[MOST_LEVELS];
};

/* Place of a cell among those of its level; coarser levels have all cells on each rank, with MARGIN
 * ghosts of 0 around. */
static int64_t at(const struct halved *l, int i, int j, int k)
{
    return (i + l->g[0]) + l->stride[1] * (j + l->g[1]) + l->stride[2] * (k + l->g[2]);
}

static int lines(const struct halved *l) { return l->n[1] * l->n[2]; }

/* Lines of cells along x that have rows: c is the first cell, len their number. */
#define HALVED_LINES(l, j, k, c, len)                                                              \
    for (int k = (l)->used[2][0], j; k < (l)->used[2][1]; k++)                                     \
        for (j = (l)->used[1][0]; j < (l)->used[1][1]; j++)                                        \
            for (int64_t c = at(l, (l)->run[j + (l)->n[1] * k][0], j, k),                          \
                         len = (l)->run[j + (l)->n[1] * k][1], its_once_##c = 1;                   \
                 its_once_##c; its_once_##c = 0)

/* --- levels --- */

/* Few ranks alone, for each repeats all of the coarser grids; and no periods, across which these do
 * not know neighbours. */
bool halving_fits(const struct block *b)
{
    int ranks;
    MPI_Comm_size(b->cart, &ranks);
    return ranks <= 1 << b->dim && !b->periodic[0] && !b->periodic[1] && !b->periodic[2];
}

/* The first level takes x and b from who asks. */
static void allocate(void *owner, struct halved *l, int dim, bool first)
{
    double **const fields[] = {&l->own, &l->diagonal, &l->per, &l->y, &l->x, &l->b};
    for (int k = 0; k < (first ? 4 : 6); k++)
        *fields[k] = NEW_IN(owner, double, l->size);
    for (int a = 0; a < dim; a++)
        l->through[a] = NEW_IN(owner, double, l->size);
    l->run = (int(*)[2])NEW_IN(owner, int, 2 * lines(l));
}

/* The axis to halve next within a group of axes that are short beside `most'; < 0: none is. */
static int shortest(const struct halved *l, int dim, double most)
{
    int axis = -1;
    for (int a = 0; a < dim; a++)
        if (l->all[a] > 1 && l->h[a] < most && (axis < 0 || l->h[a] < l->h[axis]))
            axis = a;
    return axis;
}

/* Chebyshev's steps for D^-1 A between 1 over the number of axes, the smoothest wave that is left
 * to this grid, and 2. */
static void set_shares(struct halved *l, int dim)
{
    int axes = 0;
    for (int a = 0; a < dim; a++)
        axes += l->all[a] > 1;
    const double low = 1.0 / (axes > 0 ? axes : 1), mid = 0.5 * (2.0 + low),
                 way = 0.5 * (2.0 - low) * sqrt(0.5);
    l->share[0] = 1.0 / (mid + way);
    l->share[1] = 1.0 / (mid - way);
}

/* The next level, which has half the cells along l's axis. */
static void make_next(const struct halved *l, int dim, struct halved *to)
{
    *to = (struct halved){.axis = -1};
    to->size = 1;
    for (int a = 0; a < 3; a++) {
        to->n[a] = to->all[a] = a == l->axis ? (l->all[a] + 1) / 2 : l->all[a];
        to->h[a] = a == l->axis ? 2.0 * l->h[a] : l->h[a];
        to->g[a] = a < dim ? MARGIN : 0;
        to->stride[a] = to->size;
        to->size *= to->n[a] + 2 * to->g[a];
    }
}

/* Axes whose spacings lie within 1.3 of the least are halved one after the other before the next
 * grid is relaxed. Ends with one cell. */
struct halving *halving_create(const struct block *b)
{
    struct halving *h = NEW(struct halving, 1);
    struct halved *l = h->level;
    double most = 0.0; /* of this group of axes */
    MPI_Comm_size(b->cart, &h->ranks);
    h->block = b;
    h->dim = b->dim;
    *l = (struct halved){.size = b->size, .axis = -1};
    for (int a = 0; a < 3; a++) {
        l->n[a] = b->n[a];
        l->lo[a] = b->lo[a];
        l->all[a] = b->cells[a];
        l->g[a] = b->g[a];
        l->stride[a] = b->stride[a];
        l->h[a] = b->length[a] / b->cells[a];
    }
    for (h->n = 1;; h->n++, l++) {
        allocate(h, l, h->dim, h->n == 1);
        l->axis = shortest(l, h->dim, most);
        if (l->axis < 0) {
            l->relaxes = true;
            l->axis = shortest(l, h->dim, INFINITY);
            most = l->axis < 0 ? 0.0 : 1.3 * l->h[l->axis];
        }
        set_shares(l, h->dim);
        if (l->axis < 0)
            return h;
        make_next(l, h->dim, l + 1);
    }
}

double *halving_through(struct halving *h, int a) { return h->level->through[a]; }
double *halving_own(struct halving *h) { return h->level->own; }
int *halving_run(struct halving *h, int j, int k) { return h->level->run[j + h->level->n[1] * k]; }

/* --- the matrix --- */

/* From the finest grid, which is shared out, to the next, which all have; further down every rank
 * computes the same. */
static void sum_ranks(const struct halving *h, const struct halved *l, double *q)
{
    if (l == h->level + 1 && h->ranks > 1)
        MPI_Allreduce(MPI_IN_PLACE, q, (int)l->size, MPI_DOUBLE, MPI_SUM, h->block->cart);
}

/* All fields of a level are 0 again where runs were. */
static void clear(const struct halving *h, const struct halved *l)
{
    double *const fields[] = {l->own, l->diagonal, l->per, l->y, l->x, l->b};
    HALVED_LINES (l, j, k, c, len) {
        const size_t bytes = (size_t)len * sizeof(double);
        for (int q = 0; q < (l == h->level ? 4 : 6); q++)
            memset(fields[q] + c, 0, bytes);
        for (int a = 0; a < h->dim; a++) {
            memset(l->through[a] + c, 0, bytes);
            memset(l->through[a] + c + l->stride[a], 0, bytes);
        }
    }
}

/* Lines without rows are most of them where water is low. */
static void find_used(struct halved *l)
{
    for (int a = 1; a < 3; a++) {
        l->used[a][0] = l->n[a];
        l->used[a][1] = 0;
    }
    for (int r = 0; r < lines(l); r++)
        for (int a = 1; a < 3 && l->run[r][1] > 0; a++) {
            const int at = a == 1 ? r % l->n[1] : r / l->n[1];
            l->used[a][0] = at < l->used[a][0] ? at : l->used[a][0];
            l->used[a][1] = at >= l->used[a][1] ? at + 1 : l->used[a][1];
        }
}

static void set_run(const struct halving *h, const struct halved *l, struct halved *to)
{
    for (int r = 0; r < lines(to); r++) {
        to->run[r][0] = to->n[0];
        to->run[r][1] = to->n[0]; /* less the end of the run: minima of both over the ranks */
    }
    for (int k = 0; k < l->n[2]; k++)
        for (int j = 0; j < l->n[1]; j++) {
            const int *r = l->run[j + l->n[1] * k];
            const int first = r[0] + l->lo[0], end = first + r[1], x = l->axis == 0;
            const int up[2] = {j + l->lo[1], k + l->lo[2]};
            int *t = to->run[(l->axis == 1 ? up[0] / 2 : up[0]) +
                             to->n[1] * (l->axis == 2 ? up[1] / 2 : up[1])];
            if (r[1] == 0)
                continue;
            const int low = x ? first / 2 : first, high = to->n[0] - (x ? (end + 1) / 2 : end);
            t[0] = low < t[0] ? low : t[0];
            t[1] = high < t[1] ? high : t[1];
        }
    if (l == h->level && h->ranks > 1)
        MPI_Allreduce(MPI_IN_PLACE, to->run, 2 * lines(to), MPI_INT, MPI_MIN, h->block->cart);
    for (int r = 0; r < lines(to); r++)
        to->run[r][1] = to->run[r][0] < to->n[0] ? to->n[0] - to->run[r][1] - to->run[r][0] : 0;
    find_used(to);
}

/* to += weight times what a line of a level has, whose first cell is cell `first' of the grid: at
 * the same places, or at half of them, then of even ones alone if so wanted. */
static void add_line(const double *restrict from, int64_t len, int64_t first, bool halves,
                     bool even, double weight, double *restrict to)
{
    if (!halves)
        for (int64_t i = 0; i < len; i++)
            to[first + i] += weight * from[i];
    for (int64_t i = even ? first % 2 : 0; i < len && halves; i += even ? 2 : 1)
        to[(first + i) / 2] += weight * from[i];
}

/* Conductances in series along the halved axis: the faces between two new cells pass half; faces
 * within one are gone. In parallel across it, and so on the diagonal. */
static void coarsen(const struct halving *h, const struct halved *l, struct halved *to)
{
    const int axis = l->axis;
    set_run(h, l, to);
    HALVED_LINES (l, j, k, c, len) {
        const int64_t first = c - at(l, 0, j, k) + l->lo[0];
        const int line[3] = {0, j + l->lo[1], k + l->lo[2]};
        const int64_t t =
            at(to, 0, axis == 1 ? line[1] / 2 : line[1], axis == 2 ? line[2] / 2 : line[2]);
        for (int a = 0; a < h->dim; a++)
            if (a != axis)
                add_line(l->through[a] + c, len, first, axis == 0, false, 1.0, to->through[a] + t);
            else if (axis == 0 || line[axis] % 2 == 0)
                add_line(l->through[a] + c, len, first, axis == 0, true, 0.5, to->through[a] + t);
        add_line(l->own + c, len, first, axis == 0, false, 1.0, to->own + t);
    }
    sum_ranks(h, to, to->own);
    for (int a = 0; a < h->dim; a++)
        sum_ranks(h, to, to->through[a]);
}

static void set_diagonal(const struct halving *h, struct halved *l)
{
    HALVED_LINES (l, j, k, c, len)
        for (int64_t i = c; i < c + len; i++) {
            double sum = l->own[i];
            for (int a = 0; a < h->dim; a++)
                sum += l->through[a][i] + l->through[a][i + l->stride[a]];
            l->diagonal[i] = sum;
            l->per[i] = sum > 0.0 ? 1.0 / sum : 0.0;
        }
}

void halving_begin(struct halving *h)
{
    for (int q = 0; q < h->n; q++)
        clear(h, h->level + q);
}

void halving_set_matrix(struct halving *h)
{
    find_used(h->level);
    for (int q = 0; q < h->n; q++) {
        set_diagonal(h, h->level + q);
        if (q + 1 < h->n)
            coarsen(h, h->level + q, h->level + q + 1);
    }
}

/* --- relaxation --- */

/* b plus what the neighbours of cell i have. */
#define AROUND(i)                                                                                  \
    (b[i] + wx[i] * x[i - 1] + wx[i + 1] * x[i + 1] + wy[i] * x[i - sy] + wy[i + sy] * x[i + sy])
#define AROUND_TOO(i) (wz[i] * x[i - sz] + wz[i + sz] * x[i + sz])

/* y = x + share D^-1 (b - A x), or, share < 0, b - A x. */
INLINE void relax_body(const struct halved *l, const int dim, const double *restrict b,
                       const double *restrict x, double share, double *restrict y)
{
    const double *restrict per = l->per, *restrict diagonal = l->diagonal,
                           *restrict wx = l->through[0], *restrict wy = l->through[1],
                           *restrict wz = l->through[dim == 3 ? 2 : 1];
    const int64_t sy = l->stride[1], sz = l->stride[2];
    HALVED_LINES (l, j, k, c, len) {
        if (share < 0.0)
            for (int64_t i = c; i < c + len; i++)
                y[i] = AROUND(i) + (dim == 3 ? AROUND_TOO(i) : 0.0) - diagonal[i] * x[i];
        else
            for (int64_t i = c; i < c + len; i++)
                y[i] = (1.0 - share) * x[i] +
                       share * per[i] * (AROUND(i) + (dim == 3 ? AROUND_TOO(i) : 0.0));
    }
}

/* Ghosts of the finest level are the neighbours'; those of coarser ones stay 0, as no face leads
 * there. */
static void relax(const struct halving *h, const struct halved *l, const double *b, double *x,
                  double share, double *y)
{
    if (l == h->level)
        block_halo(h->block, 1, &x);
    if (h->dim == 3)
        relax_body(l, 3, b, x, share, y);
    else
        relax_body(l, 2, b, x, share, y);
}

/* y = the first step, from 0. */
static void relax_first(const struct halved *l, const double *restrict b, double *restrict y)
{
    const double *restrict per = l->per, share = l->share[0];
    HALVED_LINES (l, j, k, c, len)
        for (int64_t i = c; i < c + len; i++)
            y[i] = share * per[i] * b[i];
}

/* --- between levels --- */

/* Cell of n along an axis, of those that give to cell J of the next level: k = 0 and 3 a quarter,
 * the two between, its own, three quarters. < 0: there is none. The first and the last have no
 * other cell to give to: all they have goes to their own. */
static int source_of(int n, int J, int k)
{
    const int m = 2 * J - 1 + k;
    if (m < 0)
        return 0;
    return m < n ? m : m == n && k == 3 ? n - 1 : -1;
}

static const double weight[4] = {0.25, 0.75, 0.75, 0.25};

/* To cell J of a line along x from a line of l. */
static double taken(const struct halved *l, const double *r, int J)
{
    double sum = 0.0;
    for (int k = 0; k < 4; k++) {
        const int m = source_of(l->all[0], J, k) - l->lo[0];
        sum += m >= 0 && m < l->n[0] ? weight[k] * r[m] : 0.0;
    }
    return sum;
}

/* To the cells from J to `end' of a line along x. */
static void restrict_line(const struct halved *l, const double *restrict r, int J, int end,
                          double *restrict out)
{
    const int lo = l->lo[0], hi = lo + l->n[0], inner = (lo + 2) / 2, last = (hi - 1) / 2;
    const double *restrict q = r - lo;
    for (; J < end && J < inner; J++)
        out[J] = taken(l, r, J);
    for (; J < end && J < last; J++)
        out[J] = 0.75 * (q[2 * J] + q[2 * J + 1]) + 0.25 * (q[2 * J - 1] + q[2 * J + 2]);
    for (; J < end; J++)
        out[J] = taken(l, r, J);
}

/* The same across lines, to cells [first, first + len) of line (j, k). Adds what each of the four
 * lines has, so a rank adds the part of its own cells. */
static void restrict_across(const struct halved *l, const double *r, int j, int k, int64_t first,
                            int64_t len, double *restrict out)
{
    const int axis = l->axis, lo = l->lo[0];
    const int64_t from = first > lo ? first : lo,
                  end = first + len < lo + l->n[0] ? first + len : lo + l->n[0];
    for (int g = 0; g < 4; g++) {
        int line[3] = {0, j - l->lo[1], k - l->lo[2]};
        line[axis] = source_of(l->all[axis], axis == 1 ? j : k, g) - l->lo[axis];
        if (line[1] < 0 || line[1] >= l->n[1] || line[2] < 0 || line[2] >= l->n[2])
            continue;
        const double *restrict q = r + at(l, 0, line[1], line[2]) - lo;
        for (int64_t i = from; i < end; i++)
            out[i] += weight[g] * q[i];
    }
}

/* to->b = what r, 0 where no rows are, has in it of the next level. */
static void restrict_to(const struct halving *h, const struct halved *l, const double *r,
                        const struct halved *to)
{
    HALVED_LINES (to, j, k, c, len) {
        const int64_t base = at(to, 0, j, k), first = c - base;
        double *out = to->b + base;
        memset(to->b + c, 0, (size_t)len * sizeof(double));
        if (len == 0)
            continue;
        if (l->axis > 0)
            restrict_across(l, r, j, k, first, len, out);
        else if (j >= l->lo[1] && j < l->lo[1] + l->n[1] && k >= l->lo[2] && k < l->lo[2] + l->n[2])
            restrict_line(l, r + at(l, 0, j - l->lo[1], k - l->lo[2]), (int)first,
                          (int)(first + len), out);
    }
    sum_ranks(h, to, to->b);
    HALVED_LINES (to, j, k, c, len) /* as prolong does */
        for (int64_t i = c; i < c + len; i++)
            to->b[i] = to->per[i] > 0.0 ? to->b[i] : 0.0;
}

/* The cell of n beside the one that cell m of twice as many lies in, on m's side; at an end that
 * itself. */
static int beside(int n, int m)
{
    const int J = m / 2, other = J + (m % 2 ? 1 : -1);
    return other >= 0 && other < n ? other : J;
}

/* x of a level: adds what the next one has, or, where nothing is yet (keep 0, else 1), sets it. */
static inline double with_next(double keep, double x, double per, double next)
{
    return keep * x + (per > 0.0 ? next : 0.0);
}

static void prolong_line(const struct halved *l, int64_t c, int64_t len, int first,
                         const double *restrict e, double *restrict x)
{
    const int n = (l->all[0] + 1) / 2;
    const double *restrict per = l->per + c, keep = l->relaxes ? 1.0 : 0.0;
    x += c;
    for (int64_t i = 0; i < len;) {
        const int m = first + (int)i, J = m / 2;
        int64_t pairs = (len - i) / 2;
        if (pairs > n - 1 - J)
            pairs = n - 1 - J;
        if (m % 2 || J == 0 || pairs <= 0) {
            x[i] = with_next(keep, x[i], per[i], 0.75 * e[J] + 0.25 * e[beside(n, m)]);
            i++;
            continue;
        }
        const double *restrict q = e + J, *restrict p = per + i;
        double *restrict to = x + i;
        for (int64_t t = 0; t < pairs; t++) {
            const double low = 0.75 * q[t] + 0.25 * q[t - 1], up = 0.75 * q[t] + 0.25 * q[t + 1];
            to[2 * t] = with_next(keep, to[2 * t], p[2 * t], low);
            to[2 * t + 1] = with_next(keep, to[2 * t + 1], p[2 * t + 1], up);
        }
        i += 2 * pairs;
    }
}

static void prolong_across(const struct halved *l, int64_t c, int64_t len, const double *restrict e,
                           const double *restrict f, double *restrict x)
{
    const double *restrict per = l->per, keep = l->relaxes ? 1.0 : 0.0;
    for (int64_t i = 0; i < len; i++)
        x[c + i] = with_next(keep, x[c + i], per[c + i], 0.75 * e[i] + 0.25 * f[i]);
}

/* x gets what the next level has found. */
static void prolong(const struct halved *l, const struct halved *from, double *x)
{
    const int axis = l->axis;
    HALVED_LINES (l, j, k, c, len) {
        const int64_t first = c - at(l, 0, j, k) + l->lo[0];
        int line[3] = {0, j + l->lo[1], k + l->lo[2]};
        if (axis == 0) {
            prolong_line(l, c, len, (int)first, from->x + at(from, 0, line[1], line[2]), x);
            continue;
        }
        const int m = line[axis];
        line[axis] = m / 2;
        const double *e = from->x + at(from, (int)first, line[1], line[2]);
        line[axis] = beside(from->n[axis], m);
        prolong_across(l, c, len, e, from->x + at(from, (int)first, line[1], line[2]), x);
    }
}

/* --- the cycle --- */

/* A V-cycle, symmetric: Chebyshev's steps come in the reverse order on the way up, so that
 * conjugate gradients may use it. The last grid is one cell, solved by its diagonal. */
void halving_cycle(struct halving *h, double *r, double *x)
{
    const int last = h->n - 1;
    for (int q = 0; q < last; q++) {
        const struct halved *l = h->level + q;
        double *b = q == 0 ? r : l->b, *to = q == 0 ? x : l->x;
        if (l->relaxes) {
            relax_first(l, b, l->y);
            relax(h, l, b, l->y, l->share[1], to);
            relax(h, l, b, to, -1.0, l->y);
        }
        restrict_to(h, l, l->relaxes ? l->y : b, l + 1);
    }
    const struct halved *end = h->level + last;
    HALVED_LINES (end, j, k, c, len)
        for (int64_t i = c; i < c + len; i++)
            (last == 0 ? x : end->x)[i] = end->per[i] * (last == 0 ? r : end->b)[i];
    for (int q = last - 1; q >= 0; q--) {
        const struct halved *l = h->level + q;
        double *b = q == 0 ? r : l->b, *to = q == 0 ? x : l->x;
        prolong(l, l + 1, to);
        if (l->relaxes) {
            relax(h, l, b, to, l->share[1], l->y);
            relax(h, l, b, l->y, l->share[0], to);
        }
    }
}
