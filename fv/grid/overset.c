/* overset.c - see overset.h.
 * Later blocks cover earlier ones. A cell must be computed if no later block can give it a value,
 * or if the fringe of a later block needs it; two layers around the computed cells are the fringe,
 * the rest is a hole. Cells behind walls of later blocks are holes from the start: found from the
 * ghosts behind the walls, and all that is connected with them and not covered. A side "overlap"
 * starts with two layers of fringe. Donors are computed cells only, of the block with the smallest
 * cell there: no chains.
 * Interpolation: tensor products of cubics through four averages in the donor's indices, averaged
 * over Gauss points of the receiving cell: averages to averages, fourth order. Where not all
 * 4^dim cells are computed: linear from 2^dim.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "overset.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../common/mem.h"
#include "mesh_motion.h"

struct bins {
    double lo[3], hi[3], size[3]; /* m */
    int n[3];
    int64_t *first; /* of each bin, and one more */
    int *cell;
    double *line[3]; /* rectilinear blocks: vertices along the axes before the rotation */
};

struct donor {
    int block, cell[3]; /* that receives */
    int from_block, from[3], linear_from[3];
    int at[3]; /* the donor cell itself */
    int width; /* of the cells that give: 4, or 2 */
    double weight[64], linear[8];
};

struct overset {
    struct bins bins[MESH_BLOCKS_MAX];
    int64_t n, room;
    struct donor *donor;
    int64_t n_old, room_old; /* those of the last search */
    struct donor *old;
    bool rows_only;             /* linear weights are found alone */
    int *last[MESH_BLOCKS_MAX]; /* of each cell in old, and one more; NULL: nothing moves */
    bool periodic[3];
    double length[3], least[3];
};

/* --- search --- */

static bool is_rectilinear(const struct mesh_block *b)
{
    return b->prm->mapping == MAPPING_BOX || b->prm->mapping == MAPPING_STRETCHED;
}

static void unrotate(const struct mesh_block_params *p, const double *x, double *y)
{
    const double a = -p->angle * M_PI / 180.0, c = cos(a), s = sin(a);
    const double X = x[0] - p->centre[0], Y = x[1] - p->centre[1];
    y[0] = p->angle == 0.0 ? x[0] : p->centre[0] + c * X - s * Y;
    y[1] = p->angle == 0.0 ? x[1] : p->centre[1] + s * X + c * Y;
    y[2] = x[2];
}

static void make_lines(const struct mesh_block *b, int dim, struct bins *s)
{
    for (int a = 0; a < dim; a++) {
        s->line[a] = NEW(double, b->n[a] + 1);
        for (int i = 0; i <= b->n[a]; i++) {
            double y[3];
            unrotate(b->prm, b->x[mesh_vertex(b, a == 0 ? i : 0, a == 1 ? i : 0, a == 2 ? i : 0)],
                     y);
            s->line[a][i] = y[a];
        }
    }
}

/* Box of a cell's vertices, a fifth wider for curved faces. */
static void cell_box(const struct mesh_block *b, int dim, const int *i, double lo[3], double hi[3])
{
    for (int c = 0; c < 3; c++) {
        lo[c] = INFINITY;
        hi[c] = -INFINITY;
    }
    for (int k = 0; k < 1 << dim; k++) {
        const double *x =
            b->x[mesh_vertex(b, i[0] + (k & 1), i[1] + (k >> 1 & 1), i[2] + (k >> 2 & 1))];
        for (int c = 0; c < 3; c++) {
            lo[c] = fmin(lo[c], x[c]);
            hi[c] = fmax(hi[c], x[c]);
        }
    }
    double most = 0.0;
    for (int c = 0; c < 3; c++)
        most = fmax(most, hi[c] - lo[c]);
    for (int c = 0; c < 3; c++) {
        lo[c] -= 0.2 * most;
        hi[c] += 0.2 * most;
    }
}

static void bin_range(const struct bins *s, const double *lo, const double *hi, int from[3],
                      int to[3])
{
    for (int c = 0; c < 3; c++) {
        from[c] = (int)fmin(fmax(floor((lo[c] - s->lo[c]) / s->size[c]), 0.0), s->n[c] - 1.0);
        to[c] = (int)fmin(fmax(floor((hi[c] - s->lo[c]) / s->size[c]), 0.0), s->n[c] - 1.0);
    }
}

/* pass 0 counts, pass 1 enters. */
static void enter_cells(const struct mesh_block *b, int dim, struct bins *s, int pass)
{
    int i[3], from[3], to[3], q[3];
    double lo[3], hi[3];
    for (i[2] = 0; i[2] < b->n[2]; i[2]++)
        for (i[1] = 0; i[1] < b->n[1]; i[1]++)
            for (i[0] = 0; i[0] < b->n[0]; i[0]++) {
                cell_box(b, dim, i, lo, hi);
                bin_range(s, lo, hi, from, to);
                for (q[2] = from[2]; q[2] <= to[2]; q[2]++)
                    for (q[1] = from[1]; q[1] <= to[1]; q[1]++)
                        for (q[0] = from[0]; q[0] <= to[0]; q[0]++) {
                            const int64_t bin = q[0] + s->n[0] * (q[1] + (int64_t)s->n[1] * q[2]);
                            if (pass == 0)
                                s->first[bin + 1]++;
                            else
                                s->cell[s->first[bin]++] = (int)mesh_cell(b, i);
                        }
            }
}

static void make_bins(const struct mesh_block *b, int dim, struct bins *s)
{
    const int64_t n = (int64_t)b->n[0] * b->n[1] * b->n[2];
    double lo[3], hi[3];
    for (int c = 0; c < 3; c++) {
        s->lo[c] = INFINITY;
        s->hi[c] = -INFINITY;
    }
    int i[3];
    for (i[2] = 0; i[2] < b->n[2]; i[2]++)
        for (i[1] = 0; i[1] < b->n[1]; i[1]++)
            for (i[0] = 0; i[0] < b->n[0]; i[0]++) {
                cell_box(b, dim, i, lo, hi);
                for (int c = 0; c < 3; c++) {
                    s->lo[c] = fmin(s->lo[c], lo[c]);
                    s->hi[c] = fmax(s->hi[c], hi[c]);
                }
            }
    const int side = (int)fmax(1.0, floor(pow((double)n, 1.0 / dim)));
    int64_t bins = 1;
    for (int c = 0; c < 3; c++) {
        s->n[c] = c < dim ? side : 1;
        s->size[c] = (s->hi[c] - s->lo[c]) / s->n[c];
        bins *= s->n[c];
    }
    s->first = NEW(int64_t, bins + 2);
    enter_cells(b, dim, s, 0);
    for (int64_t k = 0; k < bins; k++)
        s->first[k + 1] += s->first[k];
    s->cell = NEW(int, s->first[bins]);
    enter_cells(b, dim, s, 1);
    for (int64_t k = bins; k > 0; k--)
        s->first[k] = s->first[k - 1];
    s->first[0] = 0;
}

static int bisect(const double *line, int n, double x)
{
    int lo = 0, hi = n;
    while (hi - lo > 1) {
        const int mid = (lo + hi) / 2;
        if (x < line[mid])
            hi = mid;
        else
            lo = mid;
    }
    return lo;
}

/* A cell near x to start from. */
static bool near_cell(const struct mesh *m, const struct bins *s, const struct mesh_block *b,
                      const double *x, int *cell)
{
    int from[3], to[3];
    for (int c = 0; c < m->dim; c++)
        if (!(x[c] >= s->lo[c] && x[c] <= s->hi[c]))
            return false;
    if (s->line[0]) {
        double y[3];
        unrotate(b->prm, x, y);
        for (int a = 0; a < 3; a++)
            cell[a] = a < m->dim ? bisect(s->line[a], b->n[a], y[a]) : 0;
        return true;
    }
    bin_range(s, x, x, from, to);
    const int64_t bin = from[0] + s->n[0] * (from[1] + (int64_t)s->n[1] * from[2]);
    double best = INFINITY;
    for (int64_t k = s->first[bin]; k < s->first[bin + 1]; k++) {
        const double *y = b->centre[s->cell[k]];
        double d = 0.0;
        for (int c = 0; c < 3; c++) /* in 2D z adds the same to all */
            d += (x[c] - y[c]) * (x[c] - y[c]);
        if (d < best) {
            best = d;
            cell[0] = s->cell[k] % b->n[0];
            cell[1] = s->cell[k] / b->n[0] % b->n[1];
            cell[2] = s->cell[k] / b->n[0] / b->n[1];
        }
    }
    return best < INFINITY;
}

/* Newton's iteration for the place in the smooth map of a cell. */
static bool invert(const struct mesh_block *b, int dim, const int *cell, const double *x,
                   double *xi)
{
    for (int it = 0; it < 20; it++) {
        double y[3], d[3][3], e[3] = {0.0, 0.0, 0.0}, step = 0.0;
        mesh_map_point(b, dim, cell, xi, y, d);
        const double J = mesh_determinant(d);
        for (int c = 0; c < dim; c++)
            e[c] = x[c] - y[c];
        for (int a = 0; a < dim; a++) { /* row a of the inverse: cofactors over J */
            const int p = (a + 1) % 3, q = (a + 2) % 3;
            double sum = 0.0;
            for (int c = 0; c < 3; c++) {
                const int u = (c + 1) % 3, v = (c + 2) % 3;
                sum += e[c] * (d[p][u] * d[q][v] - d[p][v] * d[q][u]);
            }
            sum = fmax(-2.0, fmin(2.0, sum / J));
            xi[a] += sum;
            step = fmax(step, fabs(sum));
        }
        if (!(step < 1e3))
            return false;
        if (step < 1e-12)
            return true;
    }
    return false;
}

static bool locate(const struct mesh *m, const struct bins *s, const struct mesh_block *b,
                   const double *x, int *cell, double *xi)
{
    if (!near_cell(m, s, b, x, cell))
        return false;
    for (int walk = 0; walk < 40; walk++) {
        bool inside = true;
        xi[0] = xi[1] = xi[2] = 0.5;
        if (!invert(b, m->dim, cell, x, xi))
            return false;
        for (int a = 0; a < m->dim; a++) {
            const double slack = 1e-9;
            int step = xi[a] < -slack ? -1 : xi[a] > 1.0 + slack ? 1 : 0;
            if (step && cell[a] + step >= 0 && cell[a] + step < b->n[a]) {
                cell[a] += step;
                inside = false;
            } else if (step)
                return false;
        }
        if (inside)
            return true;
    }
    return false;
}

bool overset_locate(const struct mesh *m, const struct overset *o, int block, const double *place,
                    int *cell, double *xi)
{
    double x[3] = {place[0], place[1], place[2]};
    for (int c = 0; c < m->dim && m->moves; c++) /* some blocks may be periods away */
        if (o->periodic[c])
            x[c] -= o->length[c] * floor((x[c] - o->least[c]) / o->length[c]);
    for (int s = 0; s < 27; s++) {
        const int over[3] = {(s + 1) % 3 - 1, (s / 3 + 1) % 3 - 1, (s / 9 + 1) % 3 - 1};
        double y[3];
        bool fits = true;
        for (int c = 0; c < 3; c++) {
            fits = fits && (over[c] == 0 || o->periodic[c]);
            y[c] = x[c] + over[c] * o->length[c];
        }
        if (!fits)
            continue;
        mesh_motion_made(m->block + block, y, y);
        if (locate(m, o->bins + block, m->block[block].made, y, cell, xi))
            return true;
    }
    return false;
}

/* --- interpolation --- */

/* Weights of four (or two) averages for the value at s, in cells from the first one's lower side.
 */
static void weights(int width, double s, double *w)
{
    if (width == 2) {
        w[0] = 1.5 - s;
        w[1] = s - 0.5;
        return;
    }
    double slope[5]; /* of Lagrange's quartics through the sides, which the sums of averages fit */
    for (int k = 0; k < 5; k++) {
        slope[k] = 0.0;
        for (int l = 0; l < 5; l++) {
            double product = 1.0;
            if (l == k)
                continue;
            for (int q = 0; q < 5; q++)
                if (q != k)
                    product *= (q == l ? 1.0 : s - q) / (k - q);
            slope[k] += product;
        }
    }
    for (int j = 3; j >= 0; j--)
        w[j] = slope[j + 1] + (j < 3 ? w[j + 1] : 0.0);
}

static bool leads_on(const struct mesh_block *b, int side)
{
    return b->side[side] == MESH_JOINED || b->side[side] == MESH_PERIODIC;
}

/* Cells lo to hi - 1, which may lie behind joined sides. */
static bool computed_box(const struct mesh *m, int block, const int *lo, const int *hi)
{
    const struct mesh_block *b = m->block + block;
    bool inside = true;
    int i[3];
    for (int a = 0; a < m->dim; a++)
        inside = inside && lo[a] >= 0 && hi[a] <= b->n[a];
    for (i[2] = lo[2]; i[2] < hi[2]; i[2]++)
        for (i[1] = lo[1]; i[1] < hi[1]; i[1]++)
            for (i[0] = lo[0]; i[0] < hi[0]; i[0]++) {
                int at[3] = {i[0], i[1], i[2]}, k = block;
                double move[3] = {0.0, 0.0, 0.0};
                if (!inside && !mesh_resolve(m, &k, at, move))
                    return false;
                if (m->block[k].status[mesh_cell(m->block + k, at)] != CELL_COMPUTED)
                    return false;
            }
    return true;
}

static bool all_computed(const struct mesh *m, int block, const int *from, int width)
{
    const int to[3] = {from[0] + width, from[1] + width, m->dim == 3 ? from[2] + width : 1};
    return computed_box(m, block, from, to);
}

/* First cell of the stencil around a place; it stays among the cells. */
static bool stencil(const struct mesh *m, int block, const int *cell, const double *xi, int width,
                    int *from)
{
    const struct mesh_block *b = m->block + block;
    from[2] = 0;
    for (int a = 0; a < m->dim; a++) {
        from[a] = cell[a] - width / 2 + (xi[a] >= 0.5);
        if (from[a] < 0 && !leads_on(b, 2 * a))
            from[a] = 0;
        if (from[a] > b->n[a] - width && !leads_on(b, 2 * a + 1))
            from[a] = b->n[a] - width;
    }
    return all_computed(m, block, from, width);
}

/* xi: npoints places relative to `cell', of which the mean is taken; the first gives the stencil.
 */
bool overset_weights(const struct mesh *m, int block, const int *cell, const double *xi,
                     int npoints, int width, int *from, double *weight)
{
    const int n = m->dim == 3 ? width * width * width : width * width;
    if (!stencil(m, block, cell, xi, width, from))
        return false;
    memset(weight, 0, (size_t)n * sizeof(double));
    const int start = npoints > 1 ? 1 : 0;
    for (int g = start; g < npoints; g++) {
        double w[3][4] = {{0.0}, {0.0}, {1.0, 0.0, 0.0, 0.0}};
        for (int a = 0; a < m->dim; a++)
            weights(width, xi[3 * g + a] + cell[a] - from[a], w[a]);
        for (int k = 0; k < n; k++)
            weight[k] += w[0][k % width] * w[1][k / width % width] * w[2][k / width / width] /
                         (npoints - start);
    }
    return true;
}

/* Places of the centre and of Gauss points of a cell in the donor's indices. */
static bool gauss_places(const struct mesh *m, const struct donor *d, const double *shift,
                         const double *xi, double *places)
{
    static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
    for (int g = 0; g <= 1 << m->dim; g++) {
        double at[3] = {0.5, 0.5, 0.5}, x[3], dx[3][3], *to = places + 3 * g;
        for (int a = 0; a < m->dim && g > 0; a++)
            at[a] = gauss[(g - 1) >> a & 1];
        mesh_map_point(m->block + d->block, m->dim, d->cell, at, x, dx);
        for (int c = 0; c < 3; c++) {
            x[c] += shift[c];
            to[c] = xi[c];
        }
        mesh_motion_made(m->block + d->from_block, x, x);
        if (!invert(m->block[d->from_block].made, m->dim, d->at, x, to))
            return false;
    }
    return true;
}

/* --- what cells are --- */

/* Flags of all blocks' cells, one byte each. */
enum { WANTED = 1, SOLID = 2, COVERED = 4 };

static void index_of(const struct mesh_block *b, int64_t c, int *i)
{
    i[0] = (int)(c % b->n[0]);
    i[1] = (int)(c / b->n[0] % b->n[1]);
    i[2] = (int)(c / b->n[0] / b->n[1]);
}

static int64_t count_of(const struct mesh_block *b) { return (int64_t)b->n[0] * b->n[1] * b->n[2]; }

static bool in_overlap_layers(const struct mesh *m, const struct mesh_block *b, const int *i)
{
    for (int a = 0; a < m->dim; a++)
        if ((b->side[2 * a] == MESH_OVERLAP && i[a] < 2) ||
            (b->side[2 * a + 1] == MESH_OVERLAP && i[a] >= b->n[a] - 2))
            return true;
    return false;
}

/* Whether the stencil may move by a cell: a cut holds for a step. */
static bool keeps_giving(const struct mesh *m, int block, const int *from, int width)
{
    int lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    const struct mesh_block *b = m->block + block;
    for (int a = 0; a < m->dim; a++) {
        lo[a] = from[a] - 1;
        hi[a] = from[a] + width + 1;
        lo[a] = lo[a] < 0 && !leads_on(b, 2 * a) ? 0 : lo[a];
        hi[a] = hi[a] > b->n[a] && !leads_on(b, 2 * a + 1) ? b->n[a] : hi[a];
    }
    return computed_box(m, block, lo, hi);
}

/* Whether a later block than k (or any other one) can give a value at x by `width' cells. */
static bool can_give(const struct mesh *m, const struct overset *o, int first, int but,
                     const double *x, int width)
{
    for (int q = m->nblocks - 1; q >= first; q--) {
        int cell[3], from[3];
        double xi[3];
        if (q != but && overset_locate(m, o, q, x, cell, xi) &&
            stencil(m, q, cell, xi, width, from) && (!m->moves || keeps_giving(m, q, from, width)))
            return true;
    }
    return false;
}

/* Cells of block k that hold points behind walls of later blocks, and what hangs on to them. */
static void find_solid(const struct mesh *m, const struct overset *o, int k, unsigned char *flag)
{
    const struct mesh_block *b = m->block + k;
    int64_t *stack = NEW(int64_t, count_of(b) + 1), n = 0;
    for (int q = k + 1; q < m->nblocks; q++)
        for (int s = 0; s < 2 * m->dim; s++) {
            const struct mesh_block *w = m->block + q;
            if (w->side[s] != MESH_WALL && w->side[s] != MESH_SLIP)
                continue;
            for (int64_t c = 0; c < count_of(w); c++) {
                int i[3], cell[3];
                index_of(w, c, i);
                if (i[s / 2] != (s % 2 ? w->n[s / 2] - 1 : 0))
                    continue;
                for (int layer = 0; layer < MESH_GHOSTS; layer++) {
                    double x[3], dx[3][3], xi[3];
                    i[s / 2] += s % 2 ? 1 : -1;
                    mesh_map_point(w, m->dim, i, (double[3]){0.5, 0.5, 0.5}, x, dx);
                    if (!overset_locate(m, o, k, x, cell, xi))
                        continue;
                    const int64_t to = mesh_cell(b, cell);
                    if (!(flag[to] & (SOLID | COVERED))) {
                        flag[to] |= SOLID;
                        stack[n++] = to;
                    }
                }
            }
        }
    while (n > 0) {
        int i[3];
        index_of(b, stack[--n], i);
        for (int a = 0; a < m->dim; a++)
            for (int up = -1; up < 2; up += 2) {
                int at[3] = {i[0], i[1], i[2]};
                at[a] += up;
                if (at[a] < 0 || at[a] >= b->n[a])
                    continue;
                const int64_t to = mesh_cell(b, at);
                if (!(flag[to] & (SOLID | COVERED))) {
                    flag[to] |= SOLID;
                    stack[n++] = to;
                }
            }
    }
    mem_free(stack);
}

/* Within a later block: covered; in a hole of the latest one there: behind a wall. */
static unsigned char cover(const struct mesh *m, const struct overset *o, int k, const double *x)
{
    int cell[3];
    double xi[3];
    for (int q = m->nblocks - 1; q > k; q--)
        if (overset_locate(m, o, q, x, cell, xi)) {
            const struct mesh_block *b = m->block + q;
            const bool hole = b->status[mesh_cell(b, cell)] == CELL_HOLE;
            return hole && !in_overlap_layers(m, b, cell) ? SOLID : COVERED;
        }
    return 0;
}

/* The fringe of later blocks wants the cells around it. */
static void protect(const struct mesh *m, const struct overset *o, int k, unsigned char *flag)
{
    const struct mesh_block *b = m->block + k;
    for (int q = k + 1; q < m->nblocks; q++) {
        const struct mesh_block *w = m->block + q;
        for (int64_t c = 0; c < count_of(w); c++) {
            int i[3], cell[3];
            double xi[3];
            index_of(w, c, i);
            if (!in_overlap_layers(m, w, i) || can_give(m, o, k + 1, q, w->centre[c], 4) ||
                !overset_locate(m, o, k, w->centre[c], cell, xi))
                continue;
            const int near = m->moves ? 3 : 2; /* a cut holds for a step */
            const int deep = m->dim == 3 ? near : 0;
            for (int e = -deep; e <= deep; e++)
                for (int d = -near; d <= near; d++)
                    for (int p = -near; p <= near; p++) {
                        int at[3] = {cell[0] + p, cell[1] + d, cell[2] + e}, to = k;
                        double move[3] = {0.0, 0.0, 0.0};
                        if (mesh_resolve(m, &to, at, move) && to == k)
                            flag[mesh_cell(b, at)] |= WANTED;
                    }
        }
    }
}

static void cut(struct mesh *m, const struct overset *o, int k, unsigned char *flag)
{
    struct mesh_block *b = m->block + k;
    const int64_t n = count_of(b);
    if (k < m->nblocks - 1) {
        for (int64_t c = 0; c < n; c++)
            flag[c] |= cover(m, o, k, b->centre[c]);
        find_solid(m, o, k, flag);
        protect(m, o, k, flag);
    }
    for (int64_t c = 0; c < n; c++) {
        int i[3];
        index_of(b, c, i);
        const bool wanted = (flag[c] & WANTED) || !(flag[c] & COVERED) ||
                            !can_give(m, o, k + 1, k, b->centre[c], 4);
        b->status[c] =
            wanted && !(flag[c] & SOLID) && !in_overlap_layers(m, b, i) ? CELL_COMPUTED : CELL_HOLE;
    }
}

/* Two layers around computed cells become the fringe. */
static void make_fringe(struct mesh *m, int k)
{
    const struct mesh_block *b = m->block + k;
    const int reach = m->dim == 3 ? 2 : 0;
    for (int64_t c = 0; c < count_of(b); c++) {
        int i[3];
        index_of(b, c, i);
        if (b->status[c] != CELL_COMPUTED)
            continue;
        bool inside = true;
        for (int a = 0; a < m->dim; a++)
            inside = inside && i[a] >= 2 && i[a] < b->n[a] - 2;
        for (int e = -reach; e <= reach; e++)
            for (int d = -2; d <= 2; d++)
                for (int p = -2; p <= 2; p++) {
                    int at[3] = {i[0] + p, i[1] + d, i[2] + e}, to = k;
                    double move[3] = {0.0, 0.0, 0.0};
                    if (!inside && !mesh_resolve(m, &to, at, move))
                        continue;
                    unsigned char *s = m->block[to].status + mesh_cell(m->block + to, at);
                    if (*s == CELL_HOLE)
                        *s = CELL_FRINGE;
                }
    }
}

/* --- donors --- */

/* Between blocks at rest the weights of the last search hold, if the stencil is the same. */
static bool is_last(const struct mesh *m, const struct overset *o, struct donor *d, const int *from,
                    int width)
{
    const struct mesh_block *b = m->block + d->block;
    if (width != 4 || !o->last[d->block] || b->motion || m->block[d->from_block].motion)
        return false;
    const int at = o->last[d->block][mesh_cell(b, d->cell)] - 1;
    if (at < 0 || at >= o->n_old)
        return false;
    const struct donor *e = o->old + at;
    for (int a = 0; a < m->dim; a++)
        if (e->at[a] != d->at[a] || e->from[a] != from[a])
            return false;
    if (e->from_block != d->from_block || e->width != width)
        return false;
    *d = *e;
    return true;
}

static bool try_donor(const struct mesh *m, const struct overset *o, int q, int width,
                      const double *x, struct donor *d, double *volume)
{
    double xi[3], places[3 * 9], shift[3], y[3], dx[3][3];
    int cell[3], from[3];
    if (q == d->block || !overset_locate(m, o, q, x, cell, xi) ||
        !stencil(m, q, cell, xi, width, from))
        return false;
    const double v = m->block[q].volume[mesh_cell(m->block + q, cell)];
    if (v >= *volume)
        return false;
    struct donor e = *d;
    memcpy(e.at, cell, sizeof e.at);
    e.from_block = q;
    if (is_last(m, o, &e, from, width)) {
        *volume = v;
        *d = e;
        return true;
    }
    mesh_map_point(m->block + q, m->dim, cell, xi, y, dx);
    for (int c = 0; c < 3; c++)
        shift[c] = y[c] - x[c];
    memcpy(places, xi, sizeof xi);
    if (!o->rows_only && !gauss_places(m, &e, shift, xi, places))
        return false;
    const int n = (1 << m->dim) + 1;
    if (!o->rows_only && !overset_weights(m, q, cell, places, n, width, e.from, e.weight))
        return false;
    if (!overset_weights(m, q, cell, places, 1, 2, e.linear_from, e.linear))
        return false;
    e.width = width;
    *volume = v;
    *d = e;
    return true;
}

/* A linear stencil in the store of a cubic one: the same window, zeros around. */
static void widen(const struct mesh *m, struct donor *d)
{
    double w[64] = {0.0};
    int from[3] = {0, 0, 0};
    for (int a = 0; a < m->dim; a++)
        from[a] = d->from[a] < d->at[a] ? d->from[a] : d->at[a] - 1;
    for (int k = 0; k < 1 << m->dim; k++) {
        int64_t to = 0;
        for (int a = m->dim - 1; a >= 0; a--)
            to = 4 * to + (k >> a & 1) + d->from[a] - from[a];
        w[to] = d->weight[k];
    }
    memcpy(d->weight, w, sizeof w);
    memcpy(d->from, from, sizeof from);
}

static bool find_donor(const struct mesh *m, struct overset *o, int k, int64_t c, int64_t *linear)
{
    const double *x = m->block[k].centre[c];
    struct donor d = {.block = k};
    double volume = INFINITY;
    index_of(m->block + k, c, d.cell);
    for (int q = 0; q < m->nblocks; q++)
        try_donor(m, o, q, 4, x, &d, &volume);
    if (volume == INFINITY) {
        for (int q = 0; q < m->nblocks; q++)
            try_donor(m, o, q, 2, x, &d, &volume);
        if (volume == INFINITY)
            return false;
        if (!o->rows_only)
            widen(m, &d);
        (*linear)++;
    }
    if (o->n == o->room)
        GROW(o->donor, o->n, o->room = 2 * o->room + 256);
    o->donor[o->n++] = d;
    return true;
}

static bool find_donors(const struct run *r, struct faults *f, struct mesh *m, struct overset *o)
{
    bool all = true;
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        int64_t orphans = 0, first = 0;
        for (int64_t c = 0; c < count_of(b); c++) {
            if (b->status[c] != CELL_FRINGE)
                continue;
            if (!find_donor(m, o, k, c, &m->linear) && orphans++ == 0)
                first = c;
        }
        if (orphans == 0)
            continue;
        int i[3];
        index_of(b, first, i);
        const double *x = b->centre[first];
        mesh_fault(
            r, f, k, "name",
            "%lld orphan cells, the first (%d, %d, %d) at (%g, %g, %g) m: no other block has "
            "computed cells around it. Let the blocks overlap by at least 8 cells, or give "
            "its sides a kind",
            (long long)orphans, i[0], i[1], i[2], x[0], x[1], x[2]);
        all = false;
    }
    return all;
}

struct overset *overset_search(const struct run *r, const struct mesh *m)
{
    struct overset *o = NEW(struct overset, 1);
    for (int c = 0; c < 3; c++) {
        o->least[c] = r->scene.domain.min[c];
        o->periodic[c] = c < m->dim && r->scene.domain.periodic[c];
        o->length[c] = r->scene.domain.max[c] - r->scene.domain.min[c];
    }
    for (int k = 0; k < m->nblocks; k++) {
        make_bins(m->block[k].made, m->dim, o->bins + k);
        if (is_rectilinear(m->block + k))
            make_lines(m->block[k].made, m->dim, o->bins + k);
    }
    return o;
}

void overset_cut(struct mesh *m, const struct overset *o)
{
    m->computed = m->fringe_cells = 0;
    for (int k = m->nblocks - 1; k >= 0; k--) {
        unsigned char *flag = NEW(unsigned char, count_of(m->block + k));
        cut(m, o, k, flag);
        mem_free(flag);
    }
    for (int k = 0; k < m->nblocks; k++)
        make_fringe(m, k);
    for (int k = 0; k < m->nblocks; k++)
        for (int64_t c = 0; c < count_of(m->block + k); c++) {
            m->computed += m->block[k].status[c] == CELL_COMPUTED;
            m->fringe_cells += m->block[k].status[c] == CELL_FRINGE;
        }
}

struct overset *overset_create(const struct run *r, struct faults *f, struct mesh *m)
{
    bool overlap = false;
    for (int k = 0; k < m->nblocks; k++)
        for (int s = 0; s < 2 * m->dim; s++)
            overlap = overlap || m->block[k].side[s] == MESH_OVERLAP;
    m->has_fringe = overlap;
    if (!overlap) {
        m->computed = m->cells;
        return NEW(struct overset, 1);
    }
    struct overset *o = overset_search(r, m);
    overset_cut(m, o);
    if (!find_donors(r, f, m, o))
        overset_free(&o);
    return o;
}

void overset_free(struct overset **op)
{
    struct overset *o = *op;
    if (!o)
        return;
    for (int k = 0; k < MESH_BLOCKS_MAX; k++) {
        mem_free(o->bins[k].first);
        mem_free(o->bins[k].cell);
        for (int a = 0; a < 3; a++)
            mem_free(o->bins[k].line[a]);
        mem_free(o->last[k]);
    }
    mem_free(o->old);
    mem_free(o->donor);
    mem_free(o);
    *op = NULL;
}

/* Place, on its owner, of a stencil's first cell: seen from the donor cell. */
static int64_t place_of(const struct mesh *m, const struct donor *d, int *rank)
{
    const struct mesh_block *b = m->block + d->from_block;
    int64_t place, stride = 1;
    mesh_owner(m, d->from_block, d->at, rank, &place);
    for (int a = 0; a < m->dim; a++) {
        const int n = a == b->cut ? b->first[*rank + 1] - b->first[*rank] : b->n[a];
        place += stride * (d->from[a] - d->at[a]);
        stride *= n + 2 * MESH_GHOSTS;
    }
    return place;
}

static void make_exchange(struct mesh *m, const struct overset *o, struct mesh_exchange *x)
{
    struct mesh_request *request = NEW(struct mesh_request, o->n);
    int64_t n = 0;
    mesh_exchange_free(x);
    for (int64_t k = 0; k < o->n; k++) {
        const struct donor *d = o->donor + k;
        int rank;
        int64_t place;
        mesh_owner(m, d->block, d->cell, &rank, &place);
        if (rank != m->rank)
            continue;
        struct mesh_request *q = request + n++;
        *q = (struct mesh_request){.in = place, .block = d->from_block, .weight = d->weight};
        q->out = place_of(m, d, &q->rank);
    }
    mesh_exchange_create(m, x, 4, n, request);
    mem_free(request);
}

/* The rows of the matrix. */
static void set_fringes(struct mesh *m, const struct overset *o)
{
    mem_free(m->fringes);
    m->fringes = NEW(struct mesh_fringe, o->n);
    m->nfringe = 0;
    for (int64_t k = 0; k < o->n; k++) {
        const struct donor *d = o->donor + k;
        int rank;
        int64_t place;
        mesh_owner(m, d->block, d->cell, &rank, &place);
        if (rank != m->rank)
            continue;
        struct mesh_fringe *e = m->fringes + m->nfringe++;
        *e = (struct mesh_fringe){.place = place, .block = d->block, .donor = d->from_block};
        memcpy(e->cell, d->cell, sizeof e->cell);
        memcpy(e->from, d->linear_from, sizeof e->from);
        memcpy(e->weight, d->linear, sizeof e->weight);
    }
}

void overset_exchange(struct mesh *m, const struct overset *o)
{
    make_exchange(m, o, &m->fringe);
    set_fringes(m, o);
}

/* ---- blocks that move -------------------------------------------------------------------------
 */

static bool is_mine(const struct mesh *m, int k, const int *cell)
{
    const struct mesh_block *b = m->block + k;
    return cell[b->cut] >= b->first[m->rank] && cell[b->cut] < b->first[m->rank + 1];
}

/* The donors found become those of the last search. */
static void keep_last(struct mesh *m, struct overset *o)
{
    struct donor *const spare = o->old;
    const int64_t room = o->room_old;
    for (int64_t k = 0; k < o->n_old; k++)
        o->last[spare[k].block][mesh_cell(m->block + spare[k].block, spare[k].cell)] = 0;
    o->old = o->donor;
    o->room_old = o->room;
    o->n_old = o->n;
    o->donor = spare;
    o->room = room;
    o->n = 0;
    for (int k = 0; k < m->nblocks; k++)
        if (!o->last[k])
            o->last[k] = NEW(int, count_of(m->block + k));
    for (int64_t k = 0; k < o->n_old; k++)
        o->last[o->old[k].block][mesh_cell(m->block + o->old[k].block, o->old[k].cell)] =
            (int)k + 1;
}

static void report_orphan(struct mesh *m, int k, int64_t c)
{
    const struct mesh_block *b = m->block + k;
    const double *x = b->centre[c];
    int i[3];
    index_of(b, c, i);
    snprintf(m->trouble, sizeof m->trouble,
             "cell (%d, %d, %d) of block \"%s\" at (%g, %g, %g) m has no donors any more: no other "
             "block has computed cells around it",
             i[0], i[1], i[2], b->prm->name, x[0], x[1], x[2]);
}

/* Of this rank's cells that `wanted' says. */
static void find_again(struct mesh *m, struct overset *o, unsigned char *const *wanted)
{
    m->linear = 0;
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        for (int64_t c = 0; c < count_of(b); c++) {
            int i[3];
            if (wanted ? !wanted[k][c] : b->status[c] != CELL_FRINGE)
                continue;
            index_of(b, c, i);
            if (is_mine(m, k, i) && !find_donor(m, o, k, c, &m->linear) && !*m->trouble)
                report_orphan(m, k, c);
        }
    }
}

void overset_find(struct mesh *m, struct overset *o)
{
    keep_last(m, o);
    find_again(m, o, NULL);
    make_exchange(m, o, &m->fringe);
}

void overset_find_rows(struct mesh *m, const struct overset *o)
{
    struct overset fresh = *o;
    fresh.donor = NULL;
    fresh.n = fresh.room = fresh.n_old = 0;
    fresh.rows_only = true;
    find_again(m, &fresh, NULL);
    set_fringes(m, &fresh);
    mem_free(fresh.donor);
}

void overset_interpolate(struct mesh *m, struct overset *o, unsigned char *const *wanted, int nf,
                         double *const *f)
{
    struct mesh_exchange x = {0};
    struct overset fresh = *o;
    fresh.donor = NULL;
    fresh.n = fresh.room = fresh.n_old = 0;
    find_again(m, &fresh, wanted);
    make_exchange(m, &fresh, &x);
    mesh_exchange(m, &x, nf, f);
    mesh_exchange_free(&x);
    mem_free(fresh.donor);
}

bool overset_sound(const struct mesh *m, struct overset *o, struct overset_orphan *first)
{
    struct donor *const kept = o->donor;
    const int64_t n = o->n, room = o->room;
    int64_t linear = 0;
    bool sound = true;
    o->donor = NULL;
    o->n = o->room = 0;
    for (int k = 0; k < m->nblocks && sound; k++)
        for (int64_t c = 0; c < count_of(m->block + k) && sound; c++)
            if (m->block[k].status[c] == CELL_FRINGE && !find_donor(m, o, k, c, &linear)) {
                sound = false;
                first->block = k;
                index_of(m->block + k, c, first->cell);
                memcpy(first->x, m->block[k].centre[c], sizeof first->x);
            }
    mem_free(o->donor);
    o->donor = kept;
    o->n = n;
    o->room = room;
    return sound;
}
