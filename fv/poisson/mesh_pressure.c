/* mesh_pressure.c - the pressure of all blocks in one ParCSR matrix (hypre's IJ interface).
 * Rows of computed cells: minus the sums of the fluxes of psi, as mesh_subtract_psi has them; of
 * the fringe: psi less its linear interpolation; of holes: psi. The fringe makes the matrix
 * unsymmetric and, without an outflow, singular with a right side that no psi fits exactly. Then
 * one row is replaced by psi = 0, A_p, and the residual of that row is what the right side has too
 * much. z_w = A_p^-1 V is kept, so each solve takes out the right multiple c of the volumes:
 *   z = A_p^-1 b, c = (b - A z)_1/(V - A z_w)_1, psi = z - c z_w:  A psi = b - c V in all rows.
 * Conjugate residuals with one cycle of BoomerAMG; if the residual is not small enough again with
 * BiCGSTAB and a stronger cycle. SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/fv_boundary.h"
#include "../fv.h"
#include "../grid/fv_grid.h"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>

#include "backend.h"
#include "gcr.h"
#include "ij_rows.h"

struct mesh_pressure {
    struct matrix whole, solved; /* the second with the replaced row; the same without */
    struct vector b, x, r;
    HYPRE_Solver amg, safe, safe_amg; /* the safe pair is made when needed */
    struct gcr gcr;
    bool singular;
    HYPRE_BigInt first, last, pinned;
    const struct poisson *rows; /* borrowed */
    int n;                      /* of them */
    double shift;               /* 1/m^2 */
    double *zw, cw;             /* A_p^-1 V; residual of its row */
    double fringe;              /* diagonal of the rows of the fringe */
    /* rows of all cells as they are when computed, by first of each */
    int *row_first; /* owns the other two */
    HYPRE_BigInt *row_col;
    double *row_value;
};

/* v times psi of a cell that may lie behind a side: mirrored there, with its sign turned behind an
 * outflow. */
static void add_cell(const struct mesh *m, struct row *r, int block, const int *cell, double v)
{
    int at[3] = {cell[0], cell[1], cell[2]};
    double move[3] = {0.0, 0.0, 0.0};
    if (v == 0.0)
        return;
    if (!mesh_resolve(m, &block, at, move)) {
        const struct mesh_block *b = m->block + block;
        for (int a = 0; a < m->dim; a++) {
            const int side = at[a] < 0 ? 2 * a : at[a] >= b->n[a] ? 2 * a + 1 : -1;
            if (side < 0)
                continue;
            at[a] = side % 2 ? 2 * b->n[a] - 1 - at[a] : -1 - at[a];
            v = b->side[side] == MESH_OUTFLOW ? -v : v;
        }
        if (!mesh_resolve(m, &block, at, move))
            return;
    }
    row_add(r, (HYPRE_BigInt)mesh_row(m, block, at), v);
}

/* Minus the flux of psi through the lower face along a of cell `at', times sign. */
static void add_face(const struct mesh *m, const struct part *p, const int *local, int a,
                     double sign, struct row *r)
{
    const int64_t c = part_at(p, local[0], local[1], local[2]);
    const int at[3] = {p->lo[0] + local[0], p->lo[1] + local[1], p->lo[2] + local[2]};
    int below[3] = {at[0], at[1], at[2]};
    const double open = sign * m->open[a][c];
    below[a]--;
    add_cell(m, r, p->block, at, -open * m->G[a][a][c]);
    add_cell(m, r, p->block, below, open * m->G[a][a][c]);
    for (int t = 0; t < m->dim; t++)
        for (int q = 0; t != a && q < 4; q++) {
            int to[3] = {at[0], at[1], at[2]};
            to[a] -= q & 1;
            to[t] += q & 2 ? 1 : -1;
            add_cell(m, r, p->block, to, (q & 2 ? -0.25 : 0.25) * open * m->G[a][t][c]);
        }
}

/* The row psi - sum of weights times the donors' psi, times the mean diagonal, so that its residual
 * counts as those of the others. */
static void add_fringe(const struct mesh *m, const struct mesh_fringe *f, double scale,
                       struct row *r)
{
    for (int k = 0; k < 1 << m->dim; k++) {
        const int at[3] = {f->from[0] + (k & 1), f->from[1] + (k >> 1 & 1),
                           f->from[2] + (k >> 2 & 1)};
        add_cell(m, r, f->donor, at, -scale * f->weight[k]);
    }
}

/* psi of a given cell beside computed ones, which slopes along their faces look at. */
static void add_mirror(const struct mesh *m, const struct part *p, int64_t c, double scale,
                       struct row *r)
{
    int offset[MESH_SOURCES][3], cell[3];
    const int n = mesh_given_sources(m, p, c, offset);
    part_index(p, c, cell);
    for (int k = 0; k < n; k++) {
        int at[3];
        for (int a = 0; a < 3; a++)
            at[a] = p->lo[a] + cell[a] + offset[k][a];
        add_cell(m, r, p->block, at, -scale / n);
    }
}

static void computed_row(const struct mesh *m, const struct part *p, const int *i, struct row *r)
{
    r->n = 0;
    for (int a = 0; a < m->dim; a++) {
        int up[3] = {i[0], i[1], i[2]};
        up[a]++;
        add_face(m, p, i, a, -1.0, r);
        add_face(m, p, up, a, 1.0, r);
    }
}

/* The mean diagonal of computed cells is that of the fringe. */
static void set_scale(const struct fv *s, struct mesh_pressure *p)
{
    const struct mesh *m = s->m;
    double sum[2] = {0.0, 0.0};
    for (int q = 0; q < m->nparts; q++)
        PART_ROWS (m->part + q, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++) {
                sum[0] += s->free[i] * 2.0 * m->dim * m->G[0][0][i];
                sum[1] += s->free[i];
            }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, m->comm);
    p->fringe = sum[0] / fmax(sum[1], 1.0);
}

/* Rows of all cells as they are when computed. */
static void keep_rows(const struct fv *s, struct mesh_pressure *p)
{
    int64_t n = 0, room = 16 * (int64_t)p->n;
    struct row r;
    int i[3];
    p->row_first = NEW_IN(p, int, p->n + 1);
    p->row_col = NEW_IN(p->row_first, HYPRE_BigInt, room);
    p->row_value = NEW_IN(p->row_first, double, room);
    for (int k = 0; k < p->n; k++) {
        const struct part *part = grid_part(&s->grid, p->rows->place[k], i);
        computed_row(s->m, part, i, &r);
        if (n + r.n > room) {
            GROW_IN(p, p->row_col, room, 2 * room);
            GROW_IN(p, p->row_value, room, 2 * room);
            room *= 2;
        }
        memcpy(p->row_col + n, r.col, (size_t)r.n * sizeof *r.col);
        memcpy(p->row_value + n, r.v, (size_t)r.n * sizeof *r.v);
        p->row_first[k + 1] = (int)(n += r.n);
    }
}

/* The row of the first computed cell of all ranks, which psi = 0 replaces; its place here, or -1.
 */
static int find_pinned(const struct mesh *m, struct mesh_pressure *p)
{
    HYPRE_BigInt mine = (HYPRE_BigInt)1 << 30, least;
    for (int k = p->n - 1; k >= 0; k--)
        mine = m->status[p->rows->place[k]] == CELL_COMPUTED ? p->first + k : mine;
    MPI_Allreduce(&mine, &least, 1, HYPRE_MPI_BIG_INT, MPI_MIN, m->comm);
    p->pinned = p->singular ? least : -1;
    return p->singular && mine == least ? (int)(least - p->first) : -1;
}

/* Adds the shift to the diagonal of a row of n entries. */
static void add_shift(HYPRE_BigInt row, double shift, int n, const HYPRE_BigInt *col, double *v)
{
    for (int q = 0; q < n && shift != 0.0; q++)
        v[q] += col[q] == row ? shift : 0.0;
}

/* The matrices; of blocks that move, computed cells' rows stay for the next time. */
static void fill_matrices(struct fv *s, struct mesh_pressure *p)
{
    const struct mesh *m = s->m;
    int64_t n = 0;
    if (!p->row_first)
        keep_rows(s, p);
    set_scale(s, p);
    const int64_t room = p->row_first[p->n] + (MESH_SOURCES + 1) * (int64_t)p->n + 8 * m->nfringe;
    HYPRE_BigInt *col = NEW(HYPRE_BigInt, room);
    double *v = NEW(double, room);
    HYPRE_Int *ncols = NEW(HYPRE_Int, p->n);
    int64_t *fringe = NEW(int64_t, m->size_local);
    for (int64_t k = 0; k < m->nfringe; k++)
        fringe[m->fringes[k].place] = k + 1;
    const int pinned = find_pinned(m, p);
    int64_t pinned_at = -1;
    const struct part *part = m->part;
    for (int k = 0; k < p->n; k++) {
        const int64_t c = p->rows->place[k];
        while (c >= part->base + part->size)
            part++;
        if (m->status[c] == CELL_COMPUTED) {
            const int at = p->row_first[k];
            ncols[k] = p->row_first[k + 1] - at;
            pinned_at = k == pinned ? n : pinned_at;
            memcpy(col + n, p->row_col + at, (size_t)ncols[k] * sizeof *col);
            memcpy(v + n, p->row_value + at, (size_t)ncols[k] * sizeof *v);
            add_shift(p->first + k, p->shift * m->V[c], ncols[k], col + n, v + n);
        } else {
            struct row r = {.n = 1, .col = {p->first + k}, .v = {p->fringe}};
            if (fringe[c] > 0)
                add_fringe(m, m->fringes + fringe[c] - 1, p->fringe, &r);
            if (m->status[c] == CELL_GIVEN)
                add_mirror(m, part, c, p->fringe, &r);
            ncols[k] = r.n;
            memcpy(col + n, r.col, (size_t)r.n * sizeof *col);
            memcpy(v + n, r.v, (size_t)r.n * sizeof *v);
        }
        n += ncols[k];
    }
    matrix_create(&p->whole, s->comm, p->first, p->n, ncols, col, v);
    for (int q = 0; pinned_at >= 0 && q < ncols[pinned]; q++)
        v[pinned_at + q] = col[pinned_at + q] == p->pinned ? v[pinned_at + q] : 0.0;
    if (p->singular)
        matrix_create(&p->solved, s->comm, p->first, p->n, ncols, col, v);
    FREE(col, v, ncols, fringe);
    if (!m->moves)
        DROP(p->row_first);
}

/* The matrix that is solved: with one row replaced where psi is known up to a constant. */
static HYPRE_ParCSRMatrix matrix_of(const struct mesh_pressure *p)
{
    return p->singular ? p->solved.A : p->whole.A;
}

/* relax 3: hybrid Gauss-Seidel, 6 the symmetric one; coarsen 10: HMIS, 6 Falgout's. One cycle a
 * call, no test of convergence. */
static HYPRE_Solver make_amg(int relax, int sweeps, int coarsen)
{
    HYPRE_Solver amg;
    HYPRE(HYPRE_BoomerAMGCreate(&amg));
    HYPRE(HYPRE_BoomerAMGSetCoarsenType(amg, coarsen));
    HYPRE(HYPRE_BoomerAMGSetInterpType(amg, 6));
    HYPRE(HYPRE_BoomerAMGSetPMaxElmts(amg, 4));
    HYPRE(HYPRE_BoomerAMGSetRelaxType(amg, relax));
    HYPRE(HYPRE_BoomerAMGSetNumSweeps(amg, sweeps));
    HYPRE(HYPRE_BoomerAMGSetStrongThreshold(amg, 0.25));
    HYPRE(HYPRE_BoomerAMGSetTol(amg, 0.0));
    HYPRE(HYPRE_BoomerAMGSetMaxIter(amg, 1));
    HYPRE(HYPRE_BoomerAMGSetRelaxOrder(amg, 1));    /* coarse cells first, then the others */
    HYPRE(HYPRE_BoomerAMGSetKeepTranspose(amg, 1)); /* restricts by rows */
    return amg;
}

static void make_solver(struct mesh_pressure *p)
{
    p->amg = make_amg(3, 1, 10);
    HYPRE(HYPRE_BoomerAMGSetup(p->amg, matrix_of(p), p->b.v, p->x.v));
}

static void apply_rows(void *of, double *x, double *Ax)
{
    struct mesh_pressure *p = of;
    vector_set(&p->x, x);
    HYPRE(HYPRE_ParCSRMatrixMatvec(1.0, matrix_of(p), p->x.v, 0.0, p->r.v));
    vector_get(&p->r, Ax);
}

static void cycle_rows(void *of, double *r, double *z)
{
    struct mesh_pressure *p = of;
    memset(z, 0, (size_t)p->n * sizeof(double));
    vector_set(&p->b, r);
    vector_set(&p->x, z);
    HYPRE(HYPRE_BoomerAMGSolve(p->amg, matrix_of(p), p->b.v, p->x.v));
    vector_get(&p->x, z);
}

/* Slower and dearer, for right sides that the first cycle leaves. */
static void make_safe(const struct mesh *m, struct mesh_pressure *p)
{
    p->safe_amg = make_amg(6, 2, 6);
    HYPRE(HYPRE_ParCSRBiCGSTABCreate(m->comm, &p->safe));
    HYPRE(HYPRE_BiCGSTABSetMaxIter(p->safe, 300));
    HYPRE(HYPRE_BiCGSTABSetPrecond(p->safe, (HYPRE_PtrToSolverFcn)HYPRE_BoomerAMGSolve,
                                   (HYPRE_PtrToSolverFcn)HYPRE_BoomerAMGSetup, p->safe_amg));
    HYPRE(HYPRE_ParCSRBiCGSTABSetup(p->safe, matrix_of(p), p->b.v, p->x.v));
}

/* What rounding leaves of A x: no solver gets below it. */
static double rounding(const struct mesh_pressure *p, const double *x)
{
    return 1e-15 * p->fringe * gcr_norm(&p->gcr, x);
}

/* Again with the stronger cycle; the residual's norm then. */
static double solve_safely(struct fv *s, struct mesh_pressure *p, double *b, double tol, double *x)
{
    HYPRE_Int its = 0;
    double left;
    if (!p->safe)
        make_safe(s->m, p);
    s->totals.retries++;
    vector_set(&p->b, b);
    vector_set(&p->x, x);
    HYPRE(HYPRE_BiCGSTABSetTol(p->safe, tol));
    HYPRE(HYPRE_ParCSRBiCGSTABSolve(p->safe, matrix_of(p), p->b.v, p->x.v));
    HYPRE(HYPRE_BiCGSTABGetNumIterations(p->safe, &its));
    s->totals.iterations += its;
    vector_get(&p->x, x);
    gcr_solve(&p->gcr, b, x, 0.0, 0, &left);
    return left;
}

/* Solves for the right side b (its pinned row counts as 0), x from its start; false: not. */
static bool solve_pinned(struct fv *s, struct mesh_pressure *p, double *b, double tol, double *x)
{
    double left;
    if (p->pinned >= p->first && p->pinned <= p->last)
        b[p->pinned - p->first] = 0.0;
    const double wanted = tol * gcr_norm(&p->gcr, b);
    s->totals.iterations += gcr_solve(&p->gcr, b, x, wanted, 60, &left);
    if (left <= 2.0 * wanted || left <= rounding(p, x))
        return true;
    return solve_safely(s, p, b, tol, x) <= 10.0 * wanted;
}

/* b - A x in the replaced row, on all ranks. */
static double pinned_residual(struct fv *s, struct mesh_pressure *p, double b, double *x)
{
    double v = 0.0;
    vector_set(&p->x, x);
    HYPRE(HYPRE_ParCSRMatrixMatvec(1.0, p->whole.A, p->x.v, 0.0, p->r.v));
    if (p->pinned >= p->first && p->pinned <= p->last) {
        HYPRE(HYPRE_IJVectorGetValues(p->r.ij, 1, &p->pinned, &v));
        v = b - v;
    }
    return ranks_sum(s->m->comm, v);
}

static double in_pinned_row(const struct mesh_pressure *p, const double *b)
{
    return p->pinned >= p->first && p->pinned <= p->last ? b[p->pinned - p->first] : 0.0;
}

/* c V is no larger than the right side it is taken out of, so z_w needs a tenth of the finest
 * tolerance of the run: the start's, see fv_project_start; of blocks that move, which find it each
 * step, that of a step. */
static void solve_volumes(struct fv *s, struct mesh_pressure *p)
{
    double *b = NEW(double, p->n);
    const double tol = (s->m->moves ? 1e-2 : 1e-4) * fmin(1.0, s->prm.tol_pressure);
    memcpy(b, p->rows->V, (size_t)p->n * sizeof(double));
    if (!solve_pinned(s, p, b, tol, p->zw) &&
        !(gcr_norm(&p->gcr, p->gcr.r) < 1e-6 * gcr_norm(&p->gcr, b)))
        abort_run("the pressure matrix of the blocks cannot be solved");
    p->cw = pinned_residual(s, p, in_pinned_row(p, p->rows->V), p->zw);
    mem_free(b);
}

static void free_safe(struct mesh_pressure *p)
{
    if (!p->safe)
        return;
    HYPRE_ParCSRBiCGSTABDestroy(p->safe);
    HYPRE_BoomerAMGDestroy(p->safe_amg);
    p->safe = NULL;
}

static void close_hypre(void *of)
{
    struct mesh_pressure *p = of;
    HYPRE_BoomerAMGDestroy(p->amg);
    free_safe(p);
    matrix_free(&p->whole);
    matrix_free(&p->solved);
    vector_free(&p->b);
    vector_free(&p->x);
    vector_free(&p->r);
}

/* The last of the backends: it takes any blocks. */
static void *create(struct fv *s)
{
    const struct mesh *m = s->m;
    struct mesh_pressure *p = NEW(struct mesh_pressure, 1);
    p->rows = s->poisson;
    p->n = p->rows->n;
    p->first = p->rows->first;
    p->last = p->first + p->n - 1;
    p->singular = !mesh_bc_pressure_given(s);
    p->zw = NEW_IN(p, double, p->n);
    fill_matrices(s, p);
    vector_create(&p->b, s->comm, p->first, p->n);
    vector_create(&p->x, s->comm, p->first, p->n);
    vector_create(&p->r, s->comm, p->first, p->n);
    make_solver(p);
    mem_at_free(p, close_hypre);
    gcr_create(p, &p->gcr, m->comm, p->n, p, apply_rows, cycle_rows);
    if (p->singular)
        solve_volumes(s, p);
    return p;
}

/* The hierarchy of a matrix before serves a neighbour: its cycle has the new one on the finest
 * level. */
static void renew(struct fv *s, void *of, bool hierarchy)
{
    struct mesh_pressure *p = of;
    free_safe(p);
    matrix_free(&p->whole);
    matrix_free(&p->solved);
    fill_matrices(s, p);
    if (hierarchy) {
        HYPRE_BoomerAMGDestroy(p->amg);
        make_solver(p);
    }
    if (!p->singular)
        return;
    for (int k = 0; k < p->n; k++)
        p->zw[k] = s->fringe.z[p->rows->place[k]];
    solve_volumes(s, p);
    for (int k = 0; k < p->n; k++)
        s->fringe.z[p->rows->place[k]] = p->zw[k];
}

/* One row is free for psi = 0 only as long as the matrix is singular. */
static void set_shift(struct fv *s, void *of, double shift)
{
    struct mesh_pressure *p = of;
    if (shift == p->shift)
        return;
    free_safe(p); /* of the matrix before */
    HYPRE_BoomerAMGDestroy(p->amg);
    matrix_free(&p->whole);
    matrix_free(&p->solved);
    p->shift = shift;
    p->singular = !mesh_bc_pressure_given(s) && shift == 0.0;
    fill_matrices(s, p);
    make_solver(p);
}

static bool solve(struct fv *s, void *of, double *b, double tol, double *x, double *psi, double *c)
{
    struct mesh_pressure *p = of;
    for (int k = 0; k < p->n && s->fringe.psi; k++)
        b[k] *= s->m->status[p->rows->place[k]] == CELL_FRINGE ? p->fringe : 1.0;
    const double kept = in_pinned_row(p, b);
    const bool good = solve_pinned(s, p, b, tol, x);
    *c = p->singular ? pinned_residual(s, p, kept, x) / p->cw : 0.0;
    for (int k = 0; k < p->n; k++)
        psi[k] = x[k] - (p->singular ? *c * p->zw[k] : 0.0);
    return good;
}

/* The pinned row is solved for nothing: the mean goes out before and after. */
static void cycle(struct fv *s, void *of, double *b, double *x)
{
    struct mesh_pressure *p = of;
    (void)s;
    if (p->pinned >= p->first && p->pinned <= p->last)
        b[p->pinned - p->first] = 0.0;
    cycle_rows(of, b, x);
}

const struct backend backend_boomeramg = {.stage = 0.1,
                                          .last = 0.02,
                                          .create = create,
                                          .solve = solve,
                                          .cycle = cycle,
                                          .shift = set_shift,
                                          .renew = renew};
