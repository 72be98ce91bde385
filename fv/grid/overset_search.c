/* overset_search.c - which cell of a block holds a place: bisection in boxes, bins of bounding
 * boxes elsewhere, then Newton in the smooth map of a cell.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "mesh_motion.h"
#include "overset_inside.h"

/* Cells are boxes before the block's rotation, so that each index can be bisected. */
static bool is_rectilinear(const struct mesh_block *b)
{
    return b->prm->mapping == MAPPING_BOX || b->prm->mapping == MAPPING_STRETCHED;
}

/* The inverse of mesh_map.c's rotation. */
static void unrotate(const struct mesh_block_params *p, const double *x, double *y)
{
    const double a = -p->angle * M_PI / 180.0, c = cos(a), s = sin(a);
    const double X = x[0] - p->centre[0], Y = x[1] - p->centre[1];
    y[0] = p->angle == 0.0 ? x[0] : p->centre[0] + c * X - s * Y;
    y[1] = p->angle == 0.0 ? x[1] : p->centre[1] + s * X + c * Y;
    y[2] = x[2];
}

/* Vertices along each index of a rectilinear block. */
static void make_lines(void *owner, const struct mesh_block *b, int dim, struct bins *s)
{
    for (int a = 0; a < dim; a++) {
        s->line[a] = NEW_IN(owner, double, b->n[a] + 1);
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

/* Bins that the box lo .. hi meets, clamped to the grid of bins. */
static void bin_range(const struct bins *s, const double *lo, const double *hi, int from[3],
                      int to[3])
{
    for (int c = 0; c < 3; c++) {
        from[c] = (int)fmin(fmax(floor((lo[c] - s->lo[c]) / s->size[c]), 0.0), s->n[c] - 1.0);
        to[c] = (int)fmin(fmax(floor((hi[c] - s->lo[c]) / s->size[c]), 0.0), s->n[c] - 1.0);
    }
}

/* pass 0 counts, pass 1 enters. In pass 1 first[bin] runs to the end of its bin and is shifted back
 * by make_bins. */
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

/* About as many bins as cells; a counting sort in two passes. */
static void make_bins(void *owner, const struct mesh_block *b, int dim, struct bins *s)
{
    const int64_t n = mesh_count(b);
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
    s->first = NEW_IN(owner, int64_t, bins + 2);
    enter_cells(b, dim, s, 0);
    for (int64_t k = 0; k < bins; k++)
        s->first[k + 1] += s->first[k];
    s->cell = NEW_IN(owner, int, s->first[bins]);
    enter_cells(b, dim, s, 1);
    for (int64_t k = bins; k > 0; k--)
        s->first[k] = s->first[k - 1];
    s->first[0] = 0;
}

/* A cell near x to start from. In bins the one whose centre is nearest. false: x is outside of the
 * block's bounds. */
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
            cell[a] = a < m->dim ? lookup_row(s->line[a], 1, b->n[a], y[a]) : 0;
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

/* Newton's iteration for the place in the smooth map of a cell. Steps are cut at two cells, so that
 * it does not leave the map; 1e-12 of a cell is the end. xi comes with a first guess. */
bool overset_invert(const struct mesh_block *b, int dim, const int *cell, const double *x,
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

/* Walks from cell to cell where xi leaves [0, 1], 40 times at most. */
static bool locate(const struct mesh *m, const struct bins *s, const struct mesh_block *b,
                   const double *x, int *cell, double *xi)
{
    if (!near_cell(m, s, b, x, cell))
        return false;
    for (int walk = 0; walk < 40; walk++) {
        bool inside = true;
        xi[0] = xi[1] = xi[2] = 0.5;
        if (!overset_invert(b, m->dim, cell, x, xi))
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

/* x is tried as it is first (s = 0), then at up to 26 images. */
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

bool overset_computed(const struct mesh *m, const struct overset *o, int after, const double *x,
                      int *block, int *cell)
{
    for (int k = m->nblocks - 1; k > after; k--) {
        double place[3];
        if (overset_locate(m, o, k, x, cell, place) &&
            m->block[k].status[mesh_cell(m->block + k, cell)] == CELL_COMPUTED) {
            *block = k;
            return true;
        }
    }
    return false;
}

/* Bins are made of blocks as made: what moves is searched in its own frame. */
struct overset *overset_search(const struct run *r, const struct mesh *m)
{
    struct overset *o = NEW(struct overset, 1);
    for (int c = 0; c < 3; c++) {
        o->least[c] = r->scene.domain.min[c];
        o->periodic[c] = c < m->dim && r->scene.domain.periodic[c];
        o->length[c] = r->scene.domain.max[c] - r->scene.domain.min[c];
    }
    for (int k = 0; k < m->nblocks; k++) {
        make_bins(o, m->block[k].made, m->dim, o->bins + k);
        if (is_rectilinear(m->block + k))
            make_lines(o, m->block[k].made, m->dim, o->bins + k);
    }
    return o;
}

const bool *mesh_twice(const struct run *r, struct mesh *m, bool stays)
{
    if (!m->has_fringe || (m->twice && stays))
        return m->has_fringe ? m->twice : NULL;
    struct overset *o = m->search ? m->search : overset_search(r, m);
    if (!m->twice)
        m->twice = NEW_IN(m, bool, m->size_local);
    for (const struct part *p = m->part; p < m->part + m->nparts; p++) {
        int i[3];
        PART_CELLS (p, i, c) {
            const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
            const struct mesh_block *b = m->block + p->block;
            const int64_t own = mesh_cell(b, at);
            int block, cell[3];
            m->twice[c] = b->status[own] == CELL_COMPUTED &&
                          overset_computed(m, o, p->block, b->centre[own], &block, cell);
        }
    }
    if (o != m->search)
        FREE(o);
    return m->twice;
}
