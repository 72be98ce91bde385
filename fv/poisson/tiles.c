/* tiles.c - the pressure of joined blocks that fill one index space (a box, an L, a ring), turned
 * or not: PFMG over all of them. Its matrix leaves out the fluxes that slopes along a face make
 * where cells are skewed; the conjugate residuals round it have them. Blocks on which its cycles do
 * too little (cells of strongly different shape) are left to the others: a rough right side is
 * solved for at the start, and the cycles are counted. Given cells have rows of their own, 1, and
 * psi = 0; no flux passes their faces. SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/fv_boundary.h"
#include "../fv.h"
#include "../grid/fv_grid.h"
#include "backend.h"
#include "gcr.h"
#include "pfmg.h"

enum { TRIAL = 20 }; /* cycles that the rough right side may take: as dear as 4 of BoomerAMG */

/* A block's doubled indices X (vertex i: 2 i, cell i: 2 i + 1) are sign[a] X[a] + shift[a] along
 * axis[a] of the index space. */
struct tile {
    bool placed;
    int axis[3], sign[3], shift[3];
};

struct tiles {
    struct fv *s;
    struct tile tile[MESH_BLOCKS_MAX];
    int cells[3], period[3];
    struct pfmg *pfmg;
    struct gcr gcr;
    double *psi, *flux; /* fields */
    double *box;        /* a part's values in the order of the index space */
    double coupling;    /* about the diagonal of A */
    double least;       /* 1/m^2: shift of the cycle's matrix */
    double shift;
    bool singular;
    bool skewed; /* some cells are, and slopes along their faces read imposed ones */
};

static int common_divisor(int a, int b) { return b == 0 ? a : common_divisor(b, a % b); }

/* The neighbour's place behind a join; false: it has another orientation already. Two places of one
 * block are periods apart. */
static bool place_neighbour(struct tiles *t, const struct mesh_join *j, const struct tile *from)
{
    struct tile to = {.placed = true}, *is = t->tile + j->block;
    for (int a = 0; a < 3; a++) {
        const int sign = from->sign[a] * j->sign[a];
        to.axis[j->axis[a]] = from->axis[a];
        to.sign[j->axis[a]] = sign;
        to.shift[j->axis[a]] = from->shift[a] - sign * j->shift[a];
    }
    if (!is->placed)
        *is = to;
    for (int a = 0; a < 3; a++) {
        const int apart = abs(to.shift[a] - is->shift[a]) / 2, g = to.axis[a];
        if (to.axis[a] != is->axis[a] || to.sign[a] != is->sign[a])
            return false;
        t->period[g] = common_divisor(apart, t->period[g]);
    }
    return true;
}

/* First and last cell of a box of n local cells from lo on. */
static void box_of(const struct tile *of, const int *first, const int *n, int lo[3], int hi[3])
{
    for (int a = 0; a < 3; a++) {
        const int g = of->axis[a];
        const int one = (of->sign[a] * (2 * first[a] + 1) + of->shift[a] - 1) / 2;
        const int other = one + of->sign[a] * (n[a] - 1);
        lo[g] = one < other ? one : other;
        hi[g] = one < other ? other : one;
    }
}

/* Goes from block to block through joined sides. */
static bool place_all(struct tiles *t, const struct mesh *m)
{
    int queue[MESH_BLOCKS_MAX] = {0}, n = 1;
    t->tile[0] = (struct tile){.placed = true, .axis = {0, 1, 2}, .sign = {1, 1, 1}};
    for (int k = 0; k < n; k++)
        for (int side = 0; side < 2 * m->dim; side++) {
            const struct mesh_join *j = m->block[queue[k]].join + side;
            if (j->block < 0)
                continue;
            if (!t->tile[j->block].placed)
                queue[n++] = j->block;
            if (!place_neighbour(t, j, t->tile + queue[k]))
                return false;
        }
    return n == m->nblocks;
}

/* Doubled indices: a cell is 2. */
static void shift_along(struct tile *t, int g, int cells)
{
    for (int a = 0; a < 3; a++)
        t->shift[a] += t->axis[a] == g ? 2 * cells : 0;
}

/* Moves all blocks along g into one period, if there is one, the lowest to 0; false: no such. */
static bool settle(struct tiles *t, const struct mesh *m, int g, int lo[][3], int hi[][3])
{
    static const int first[3] = {0, 0, 0};
    const int period = t->period[g];
    int least = 0, most = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < m->nblocks; k++) {
            box_of(t->tile + k, first, m->block[k].n, lo[k], hi[k]);
            if (pass == 0 && period > 0) {
                const int in = ((lo[k][g] - lo[0][g]) % period + period) % period;
                shift_along(t->tile + k, g, lo[0][g] + in - lo[k][g]);
                box_of(t->tile + k, first, m->block[k].n, lo[k], hi[k]);
            } else if (pass == 1)
                shift_along(t->tile + k, g, -least);
            least = pass == 0 && (k == 0 || lo[k][g] < least) ? lo[k][g] : least;
            most = pass == 0 && (k == 0 || hi[k][g] > most) ? hi[k][g] : most;
        }
    t->cells[g] = most - least + 1;
    return period == 0 || period == t->cells[g];
}

/* Whether two boxes share a cell: blocks that overlap make no index space. */
static bool meet(const int *lo, const int *hi, const int *low, const int *high)
{
    bool all = true;
    for (int g = 0; g < 3; g++)
        all = all && lo[g] <= high[g] && low[g] <= hi[g];
    return all;
}

/* All blocks in one index space that starts at 0; false: they make none. */
static bool place(struct tiles *t, const struct mesh *m)
{
    int lo[MESH_BLOCKS_MAX][3], hi[MESH_BLOCKS_MAX][3];
    bool good = place_all(t, m);
    for (int g = 0; g < 3 && good; g++)
        good = settle(t, m, g, lo, hi);
    for (int k = 0; k < m->nblocks && good; k++)
        box_of(t->tile + k, (int[3]){0, 0, 0}, m->block[k].n, lo[k], hi[k]);
    for (int k = 0; k < m->nblocks && good; k++)
        for (int l = 0; l < k; l++)
            good = good && !meet(lo[k], hi[k], lo[l], hi[l]);
    return good;
}

/* Where the part's cell (0, 0, 0) is among the values of its box, and the steps along its axes. */
static int64_t box_steps(const struct tiles *t, const struct part *p, int64_t step[3])
{
    const struct tile *of = t->tile + p->block;
    int64_t stride[3] = {1, 1, 1}, first = 0;
    int n[3];
    for (int a = 0; a < 3; a++)
        n[of->axis[a]] = p->n[a];
    stride[1] = n[0];
    stride[2] = (int64_t)n[0] * n[1];
    for (int a = 0; a < 3; a++) {
        step[a] = of->sign[a] * stride[of->axis[a]];
        first += of->sign[a] < 0 ? (p->n[a] - 1) * stride[of->axis[a]] : 0;
    }
    return first;
}

/* Whether the order of its cells is not that of the index space. */
static bool is_turned(const struct tile *of)
{
    bool turned = false;
    for (int a = 0; a < 3; a++)
        turned = turned || of->axis[a] != a || of->sign[a] < 0;
    return turned;
}

/* Copies a part's rows to the order of the index space, or back. */
static void turn(const struct tiles *t, const struct part *p, bool back, double *rows, double *box)
{
    int64_t step[3], first = box_steps(t, p, step), r = 0;
    for (int k = 0; k < p->n[2]; k++)
        for (int j = 0; j < p->n[1]; j++) {
            double *at = box + first + j * step[1] + k * step[2];
            for (int i = 0; i < p->n[0]; i++, r++) {
                if (back)
                    rows[r] = at[i * step[0]];
                else
                    at[i * step[0]] = rows[r];
            }
        }
}

/* What the face of a cell towards `to' has in the row: its own and the neighbour's coefficient. */
static void add_face(const struct mesh *m, int a, int64_t face, int64_t to, double *own,
                     double *other)
{
    const double w = m->G[a][a][face];
    const bool inside = m->status[to] == CELL_COMPUTED;
    *other = inside ? -w : 0.0;
    *own += inside ? w : m->open[a][face] == 1.0 ? 2.0 * w : 0.0;
}

/* Owned by the caller (mem_free), in the order of the index space. */
static double *rows_of(const struct tiles *t, const struct part *p)
{
    const struct mesh *m = t->s->m;
    const struct tile *of = t->tile + p->block;
    const int width = 2 * m->dim + 1;
    int64_t step[3], first = box_steps(t, p, step);
    double *rows = NEW(double, (int64_t)width * p->n[0] * p->n[1] * p->n[2]);
    int i[3];
    PART_CELLS (p, i, c) {
        double *row = rows + width * (first + i[0] * step[0] + i[1] * step[1] + i[2] * step[2]);
        row[0] = m->status[c] == CELL_COMPUTED ? m->V[c] * fmax(t->shift, t->least) : 1.0;
        for (int a = 0; a < m->dim && m->status[c] == CELL_COMPUTED; a++) {
            const int64_t d = p->stride[a];
            const int below = 1 + 2 * of->axis[a] + (of->sign[a] < 0),
                      above = 1 + 2 * of->axis[a] + (of->sign[a] > 0);
            add_face(m, a, c, c - d, row, row + below);
            add_face(m, a, c + d, c + d, row, row + above);
        }
    }
    return rows;
}

static void set_matrix(struct tiles *t)
{
    double *rows[MESH_BLOCKS_MAX];
    for (int q = 0; q < t->s->grid.nparts; q++)
        rows[q] = rows_of(t, t->s->grid.part + q);
    pfmg_set_matrix(t->pfmg, rows);
    for (int q = 0; q < t->s->grid.nparts; q++)
        mem_free(rows[q]);
}

/* Mean spacings along the axes of the index space: by sums of couplings, V/h^2 each. */
static void mean_spacings(struct tiles *t, double h[3])
{
    const struct mesh *m = t->s->m;
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        int i[3];
        PART_CELLS (p, i, c) {
            sums[3] += m->V[c];
            for (int a = 0; a < m->dim; a++)
                sums[t->tile[p->block].axis[a]] += m->G[a][a][c];
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, m->comm);
    for (int a = 0; a < 3; a++) {
        h[a] = a < m->dim ? sqrt(sums[3] / sums[a]) : 1.0;
        t->coupling += 2.0 * sums[a] / (double)m->cells;
    }
}

/* Spacings are means, for PFMG asks which axis to halve next. */
static void make_pfmg(struct tiles *t)
{
    const struct mesh *m = t->s->m;
    int lo[MESH_BLOCKS_MAX][3], hi[MESH_BLOCKS_MAX][3];
    double L = 0.0;
    struct pfmg_grid g = {
        .comm = m->comm, .dim = m->dim, .uneven = true, .nboxes = m->nparts, .lo = lo, .hi = hi};
    mean_spacings(t, g.h);
    for (int q = 0; q < m->nparts; q++)
        box_of(t->tile + m->part[q].block, m->part[q].lo, m->part[q].n, lo[q], hi[q]);
    for (int a = 0; a < 3; a++) {
        g.cells[a] = t->cells[a];
        g.periodic[a] = t->period[a] != 0;
        L = fmax(L, a < m->dim ? t->cells[a] * g.h[a] : 0.0);
    }
    t->least = 1e-2 / (L * L); /* see pressure.c */
    t->pfmg = mem_own(t, pfmg_create(&g));
    set_matrix(t);
}

/* Rows to hypre's boxes, the cycle, and back; a block that lies in the index space as it is needs
 * no copy. */
static void cycle_rows(void *of, double *r, double *z)
{
    struct tiles *t = of;
    const struct fv *s = t->s;
    for (int pass = 0; pass < 2; pass++) {
        int64_t row = 0;
        for (int q = 0; q < s->grid.nparts; q++) {
            const struct part *p = s->grid.part + q;
            int outer[2][3];
            box_of(t->tile + p->block, p->lo, p->n, outer[0], outer[1]);
            const bool turned = is_turned(t->tile + p->block);
            double *const rows = (pass ? z : r) + row, *const box = turned ? t->box : rows;
            if (turned && pass == 0)
                turn(t, p, false, rows, box);
            if (pass == 0)
                pfmg_put(t->pfmg, q, outer, box);
            else
                pfmg_get(t->pfmg, q, outer, box);
            if (turned && pass == 1)
                turn(t, p, true, rows, box);
            row += (int64_t)p->n[0] * p->n[1] * p->n[2];
        }
        if (pass == 0)
            pfmg_cycle(t->pfmg);
    }
}

/* ---- A x ---- */

static void even_row(const double *restrict q, const int64_t *stride, const double *w, int dim,
                     int64_t n, double *restrict out)
{
    const int64_t y = stride[1], z = stride[2];
    const double own = 2.0 * (w[0] + w[1] + (dim == 3 ? w[2] : 0.0));
    if (dim == 2)
        for (int64_t i = 0; i < n; i++)
            out[i] = own * q[i] - w[0] * (q[i - 1] + q[i + 1]) - w[1] * (q[i - y] + q[i + y]);
    else
        for (int64_t i = 0; i < n; i++)
            out[i] = own * q[i] - w[0] * (q[i - 1] + q[i + 1]) - w[1] * (q[i - y] + q[i + y]) -
                     w[2] * (q[i - z] + q[i + z]);
}

/* Beside given cells: only through open faces. */
static void add_open_row(const double *restrict q, const double *restrict G,
                         const double *restrict open, int64_t d, bool first, int64_t n,
                         double *restrict out)
{
    for (int64_t i = 0; i < n; i++)
        out[i] = (first ? 0.0 : out[i]) + open[i] * G[i] * (q[i] - q[i - d]) -
                 open[i + d] * G[i + d] * (q[i + d] - q[i]);
}

static void add_upright_row(const double *restrict q, const double *restrict G, int64_t d,
                            bool first, int64_t n, double *restrict out)
{
    for (int64_t i = 0; i < n; i++)
        out[i] = (first ? 0.0 : out[i]) + G[i] * (q[i] - q[i - d]) - G[i + d] * (q[i + d] - q[i]);
}

/* Ghosts that mirror psi make no flux through closed sides; only slopes along them would. */
static void apply_part(const struct tiles *t, const struct part *p, double *out)
{
    const struct mesh *m = t->s->m;
    const double *psi = t->psi;
    double w[3];
    for (int a = 0; a < m->dim; a++)
        w[a] = m->G[a][a][part_at(p, 0, 0, 0)];
    PART_ROWS (p, no_layers, no_layers, c, n) {
        if (m->has_given)
            for (int a = 0; a < m->dim; a++)
                add_open_row(psi + c, m->G[a][a] + c, m->open[a] + c, p->stride[a], a == 0, n, out);
        else if (p->kind == PART_EVEN)
            even_row(psi + c, p->stride, w, m->dim, n, out);
        else
            for (int a = 0; a < m->dim; a++)
                add_upright_row(psi + c, m->G[a][a] + c, p->stride[a], a == 0, n, out);
        out += n;
    }
}

/* Fluxes that slopes of psi along a face make, as mesh_subtract_psi has them; they need the
 * mirrored ghosts. */
static void add_skewed(const struct tiles *t, const struct part *p, double *out)
{
    const struct mesh *m = t->s->m;
    const double *psi = t->psi;
    double *F = t->flux;
    for (int a = 0; a < m->dim; a++) {
        const int64_t d = p->stride[a];
        int up[3] = {0, 0, 0};
        double *row = out;
        up[a] = 1;
        PART_ROWS (p, no_layers, up, c, n)
            for (int64_t i = c; i < c + n; i++)
                F[i] = 0.0;
        for (int b = 0; b < m->dim; b++)
            if (b != a)
                PART_ROWS (p, no_layers, up, c, n)
                    for (int64_t i = c; i < c + n; i++) {
                        const int64_t e = p->stride[b];
                        F[i] += 0.25 * m->open[a][i] * m->G[a][b][i] *
                                (psi[i + e] - psi[i - e] + psi[i - d + e] - psi[i - d - e]);
                    }
        PART_ROWS (p, no_layers, no_layers, c, n) {
            for (int64_t i = 0; i < n; i++)
                row[i] += F[c + i] - F[c + i + d];
            row += n;
        }
    }
}

static void apply_rows(void *of, double *x, double *Ax)
{
    struct tiles *t = of;
    struct fv *s = t->s;
    const double *from = x;
    double *to = Ax;
    for (int q = 0; q < s->grid.nparts; q++)
        PART_ROWS (s->grid.part + q, no_layers, no_layers, c, n) {
            memcpy(t->psi + c, from, (size_t)n * sizeof(double));
            from += n;
        }
    if (s->forcing && t->skewed)
        given_mirror(s, t->psi);
    else
        mesh_halo(s->m, 1, &t->psi);
    mesh_bc_even(s, true, t->psi);
    for (int q = 0; q < s->grid.nparts; q++) {
        const struct part *p = s->grid.part + q;
        apply_part(t, p, to);
        if (p->kind == PART_CURVED)
            add_skewed(t, p, to);
        to += (int64_t)p->n[0] * p->n[1] * p->n[2];
    }
    for (int i = 0; i < t->gcr.n && s->forcing; i++)
        Ax[i] *= s->poisson->V[i] > 0.0 ? 1.0 : 0.0;
}

/* ---- the back end ---- */

/* b -= c V so that its sum is 0. */
static double balance(const struct tiles *t, double *b)
{
    const struct poisson *rows = t->s->poisson;
    double sum = 0.0;
    if (!t->singular)
        return 0.0;
    for (int i = 0; i < t->gcr.n; i++)
        sum += b[i];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, t->gcr.comm);
    for (int i = 0; i < t->gcr.n; i++)
        b[i] -= sum / rows->volumes * rows->V[i];
    return sum / rows->volumes;
}

/* Whether the cycles get a rough right side down by 1e-4: it changes its sign from cell to cell in
 * no regular way, the same on any ranks. */
static bool is_fast(struct tiles *t)
{
    const struct fv *s = t->s;
    double *b = NEW(double, t->gcr.n), *x = NEW_IN(t, double, t->gcr.n), *to = b, left;
    for (int q = 0; q < s->grid.nparts; q++) {
        const struct part *p = s->grid.part + q;
        int i[3];
        PART_CELLS (p, i, c) {
            uint32_t k = (uint32_t)(p->lo[0] + i[0]) * 73856093u ^
                         (uint32_t)(p->lo[1] + i[1]) * 19349663u ^
                         (uint32_t)(p->lo[2] + i[2]) * 83492791u ^ (uint32_t)p->block * 2654435761u;
            k = (k ^ k >> 15) * 2246822519u;
            *to++ = s->free[c] * s->m->V[c] * ((k >> 8 & 0xffff) / 65536.0 - 0.5);
        }
    }
    balance(t, b);
    const double goal = 1e-4 * gcr_norm(&t->gcr, b);
    gcr_solve(&t->gcr, b, x, goal, TRIAL, &left);
    FREE(b, x);
    return left <= goal;
}

static void *create(struct fv *s)
{
    const struct mesh *m = s->m;
    struct tiles *t = NEW(struct tiles, 1);
    t->s = s;
    if (m->has_fringe || !place(t, m)) {
        mem_free(t);
        return NULL;
    }
    t->singular = !mesh_bc_pressure_given(s);
    t->psi = mem_own(t, mesh_field(m));
    t->flux = mem_own(t, mesh_field(m));
    t->box = NEW_IN(t, double, s->poisson->n);
    gcr_create(t, &t->gcr, m->comm, s->poisson->n, t, apply_rows, cycle_rows);
    t->gcr.galerkin = true;
    for (int k = 0; k < m->nparts; k++)
        t->skewed = t->skewed || m->part[k].kind == PART_CURVED;
    MPI_Allreduce(MPI_IN_PLACE, &t->skewed, 1, MPI_C_BOOL, MPI_LOR, m->comm);
    make_pfmg(t);
    if (is_fast(t))
        return t;
    mem_free(t);
    return NULL;
}

static bool solve(struct fv *s, void *of, double *b, double tol, double *x, double *psi, double *c)
{
    struct tiles *t = of;
    double left;
    *c = balance(t, b);
    const double wanted = tol * gcr_norm(&t->gcr, b);
    s->totals.iterations += gcr_solve(&t->gcr, b, x, wanted, 60, &left);
    memcpy(psi, x, (size_t)t->gcr.n * sizeof(double));
    return left <= wanted || left <= 1e-15 * t->coupling * gcr_norm(&t->gcr, x);
}

static void cycle(struct fv *s, void *of, double *b, double *x)
{
    (void)s;
    cycle_rows(of, b, x);
}

static void set_shift(struct fv *s, void *of, double shift)
{
    struct tiles *t = of;
    (void)s;
    if (shift == t->shift)
        return;
    t->shift = shift;
    set_matrix(t);
}

const struct backend backend_pfmg = {.stage = 1.0,
                                     .last = 1.0,
                                     .create = create,
                                     .solve = solve,
                                     .cycle = cycle,
                                     .shift = set_shift};
