/* mesh_pressure.c - the pressure of all blocks in one ParCSR matrix (hypre's IJ interface).
 * Rows of computed cells: minus the sums of the fluxes of psi, as mesh_subtract_psi has them; of
 * the fringe: psi less its linear interpolation; of holes: psi. The fringe makes the matrix
 * unsymmetric and, without an outflow, singular with a right side that no psi fits exactly. Then
 * one row is replaced by psi = 0, A_p, and the residual of that row is what the right side has too
 * much. z_w = A_p^-1 V is kept, so each solve takes out the right multiple c of the volumes:
 *   z = A_p^-1 b, c = (b - A z)_1/(V - A z_w)_1, psi = z - c z_w:  A psi = b - c V in all rows.
 * GMRES with one cycle of BoomerAMG; the true residual is looked at; if it is not small enough
 * again with BiCGSTAB and a stronger cycle. SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/mesh_bc.h"
#include "../operators/mesh_ops.h"
#include "mesh_pressure.h"
#include "../fv.h"
#include "../grid/mesh.h"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>
#include <math.h>
#include <string.h>

#include "../../common/log.h"
#include "../../common/mem.h"
#include "hypre_call.h"

enum { ROW_MAX = 96 };

struct matrix {
    HYPRE_IJMatrix ij;
    HYPRE_ParCSRMatrix A;
};
struct vector {
    HYPRE_IJVector ij;
    HYPRE_ParVector v;
};

struct mesh_pressure {
    struct matrix whole, solved; /* the second with the replaced row; the same without */
    struct vector b, x, r;
    HYPRE_Solver gmres, amg, safe, safe_amg; /* the safe pair is made when needed */
    bool singular;
    HYPRE_BigInt first, last, pinned;
    int n;          /* rows of this rank */
    int64_t *place; /* of each row */
    double *value, *residual;
    HYPRE_BigInt *row;
    double *zw, cw; /* A_p^-1 V; residual of its row */
    double *volume; /* right side V of computed cells */
    double volumes; /* m^dim: of all computed cells */
    double fringe;  /* diagonal of the rows of the fringe */
    /* of blocks that move: rows of all cells as they are when computed, by first of each */
    int *row_first;
    HYPRE_BigInt *row_col;
    double *row_value;
};

/* A row under way. */
struct row {
    int n;
    HYPRE_BigInt col[ROW_MAX];
    double v[ROW_MAX];
};

static void add(struct row *r, HYPRE_BigInt col, double v)
{
    for (int k = 0; k < r->n; k++)
        if (r->col[k] == col) {
            r->v[k] += v;
            return;
        }
    require(r->n < ROW_MAX);
    r->col[r->n] = col;
    r->v[r->n++] = v;
}

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
    add(r, (HYPRE_BigInt)mesh_row(m, block, at), v);
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

static void add_fringe(const struct mesh *m, const struct mesh_fringe *f, double scale,
                       struct row *r)
{
    for (int k = 0; k < 1 << m->dim; k++) {
        const int at[3] = {f->from[0] + (k & 1), f->from[1] + (k >> 1 & 1),
                           f->from[2] + (k >> 2 & 1)};
        add_cell(m, r, f->donor, at, -scale * f->weight[k]);
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

static void make_row(const struct mesh *m, const struct part *p, const int *i,
                     const struct mesh_fringe *fringe, double scale, struct row *r)
{
    const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
    const int64_t c = part_at(p, i[0], i[1], i[2]);
    if (m->status[c] == CELL_COMPUTED) {
        computed_row(m, p, i, r);
        return;
    }
    r->n = 0;
    add(r, (HYPRE_BigInt)mesh_row(m, p->block, at), scale);
    if (m->status[c] == CELL_FRINGE)
        add_fringe(m, fringe, scale, r);
}

static void create_matrix(const struct mesh *m, struct mesh_pressure *p, struct matrix *A)
{
    HYPRE(HYPRE_IJMatrixCreate(m->comm, p->first, p->last, p->first, p->last, &A->ij));
    HYPRE(HYPRE_IJMatrixSetObjectType(A->ij, HYPRE_PARCSR));
    HYPRE(HYPRE_IJMatrixInitialize(A->ij));
}

static void finish_matrix(struct matrix *A)
{
    HYPRE(HYPRE_IJMatrixAssemble(A->ij));
    HYPRE(HYPRE_IJMatrixGetObject(A->ij, (void **)&A->A));
}

static void set_row(struct matrix *A, HYPRE_BigInt row, struct row *r)
{
    HYPRE_Int n = r->n;
    HYPRE(HYPRE_IJMatrixSetValues(A->ij, 1, &n, &row, r->col, r->v));
}

/* The mean diagonal of computed cells is that of the fringe. */
static void set_scale(const struct fv *s, struct mesh_pressure *p)
{
    static const int none[3] = {0, 0, 0};
    const struct mesh *m = s->m;
    double sum[2] = {0.0, 0.0};
    for (int q = 0; q < m->nparts; q++)
        PART_ROWS (m->part + q, none, none, c, n)
            for (int64_t i = c; i < c + n; i++) {
                sum[0] += s->free[i] * 2.0 * m->dim * m->G[0][0][i];
                sum[1] += s->free[i];
            }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, m->comm);
    p->fringe = sum[0] / fmax(sum[1], 1.0);
}

static void fill_matrices(struct fv *s, struct mesh_pressure *p)
{
    const struct mesh *m = s->m;
    struct row r, pin = {0};
    int64_t *fringe = NEW(int64_t, m->size_local);
    set_scale(s, p);
    for (int64_t k = 0; k < m->nfringe; k++)
        fringe[m->fringes[k].place] = k;
    create_matrix(m, p, &p->whole);
    if (p->singular)
        create_matrix(m, p, &p->solved);
    HYPRE_BigInt row = p->first, pinned = -1;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *part = m->part + q;
        int i[3];
        for (i[2] = 0; i[2] < part->n[2]; i[2]++)
            for (i[1] = 0; i[1] < part->n[1]; i[1]++)
                for (i[0] = 0; i[0] < part->n[0]; i[0]++, row++) {
                    const int64_t c = part_at(part, i[0], i[1], i[2]);
                    make_row(m, part, i, m->fringes + fringe[c], p->fringe, &r);
                    p->place[row - p->first] = c;
                    p->row[row - p->first] = row;
                    set_row(&p->whole, row, &r);
                    if (p->singular)
                        set_row(&p->solved, row, &r);
                    if (pinned < 0 && m->status[c] == CELL_COMPUTED) {
                        pinned = row;
                        pin = r;
                    }
                }
    }
    /* one cell of all: of the lowest rank that has one */
    HYPRE_BigInt mine = pinned < 0 ? (HYPRE_BigInt)1 << 30 : pinned, least;
    MPI_Allreduce(&mine, &least, 1, HYPRE_MPI_BIG_INT, MPI_MIN, m->comm);
    p->pinned = p->singular ? least : -1;
    if (p->singular && pinned == least) {
        for (int k = 0; k < pin.n; k++)
            pin.v[k] = pin.col[k] == pinned ? pin.v[k] : 0.0;
        set_row(&p->solved, pinned, &pin);
    }
    mem_free(fringe);
    finish_matrix(&p->whole);
    if (p->singular)
        finish_matrix(&p->solved);
}

/* ---- of blocks that move: what computed cells' rows are stays, the rest is small ---- */

static void keep_rows(const struct mesh *m, struct mesh_pressure *p)
{
    int64_t n = 0, room = 16 * (int64_t)p->n;
    HYPRE_BigInt k = 0;
    p->row_first = NEW(int, p->n + 1);
    p->row_col = NEW(HYPRE_BigInt, room);
    p->row_value = NEW(double, room);
    for (int q = 0; q < m->nparts; q++) {
        const struct part *part = m->part + q;
        struct row r;
        int i[3];
        PART_CELLS (part, i, c) {
            computed_row(m, part, i, &r);
            if (n + r.n > room) {
                GROW(p->row_col, room, 2 * room);
                GROW(p->row_value, room, 2 * room);
                room *= 2;
            }
            memcpy(p->row_col + n, r.col, (size_t)r.n * sizeof *r.col);
            memcpy(p->row_value + n, r.v, (size_t)r.n * sizeof *r.v);
            p->place[k] = c;
            p->row[k] = p->first + k;
            p->row_first[++k] = (int)(n += r.n);
        }
    }
}

/* The row of the first computed cell of all ranks, which psi = 0 replaces; its place here, or -1.
 */
static int find_pinned(const struct mesh *m, struct mesh_pressure *p)
{
    HYPRE_BigInt mine = (HYPRE_BigInt)1 << 30, least;
    for (int k = p->n - 1; k >= 0; k--)
        mine = m->status[p->place[k]] == CELL_COMPUTED ? p->first + k : mine;
    MPI_Allreduce(&mine, &least, 1, HYPRE_MPI_BIG_INT, MPI_MIN, m->comm);
    p->pinned = p->singular ? least : -1;
    return p->singular && mine == least ? (int)(least - p->first) : -1;
}

static void set_matrix(const struct mesh *m, struct mesh_pressure *p, struct matrix *A,
                       HYPRE_Int *ncols, const HYPRE_BigInt *col, const double *v)
{
    HYPRE(HYPRE_IJMatrixCreate(m->comm, p->first, p->last, p->first, p->last, &A->ij));
    HYPRE(HYPRE_IJMatrixSetObjectType(A->ij, HYPRE_PARCSR));
    HYPRE(HYPRE_IJMatrixSetRowSizes(A->ij, ncols));
    HYPRE(HYPRE_IJMatrixInitialize(A->ij));
    if (p->n > 0)
        HYPRE(HYPRE_IJMatrixSetValues(A->ij, p->n, ncols, p->row, col, v));
    finish_matrix(A);
}

static void fill_anew(struct fv *s, struct mesh_pressure *p)
{
    const struct mesh *m = s->m;
    int64_t n = 0;
    if (!p->row_first)
        keep_rows(m, p);
    set_scale(s, p);
    const int64_t room = p->row_first[p->n] + 9 * (m->nfringe + p->n);
    HYPRE_BigInt *col = NEW(HYPRE_BigInt, room);
    double *v = NEW(double, room);
    HYPRE_Int *ncols = NEW(HYPRE_Int, p->n);
    int64_t *fringe = NEW(int64_t, m->size_local);
    for (int64_t k = 0; k < m->nfringe; k++)
        fringe[m->fringes[k].place] = k + 1;
    const int pinned = find_pinned(m, p);
    int64_t pinned_at = -1;
    for (int k = 0; k < p->n; k++) {
        const int64_t c = p->place[k];
        if (m->status[c] == CELL_COMPUTED) {
            const int at = p->row_first[k];
            ncols[k] = p->row_first[k + 1] - at;
            pinned_at = k == pinned ? n : pinned_at;
            memcpy(col + n, p->row_col + at, (size_t)ncols[k] * sizeof *col);
            memcpy(v + n, p->row_value + at, (size_t)ncols[k] * sizeof *v);
        } else {
            struct row r = {.n = 1, .col = {p->row[k]}, .v = {p->fringe}};
            if (fringe[c] > 0)
                add_fringe(m, m->fringes + fringe[c] - 1, p->fringe, &r);
            ncols[k] = r.n;
            memcpy(col + n, r.col, (size_t)r.n * sizeof *col);
            memcpy(v + n, r.v, (size_t)r.n * sizeof *v);
        }
        n += ncols[k];
    }
    set_matrix(m, p, &p->whole, ncols, col, v);
    for (int q = 0; pinned_at >= 0 && q < ncols[pinned]; q++)
        v[pinned_at + q] = col[pinned_at + q] == p->pinned ? v[pinned_at + q] : 0.0;
    if (p->singular)
        set_matrix(m, p, &p->solved, ncols, col, v);
    mem_free(col);
    mem_free(v);
    mem_free(ncols);
    mem_free(fringe);
}

static void create_vector(const struct mesh *m, struct mesh_pressure *p, struct vector *v)
{
    HYPRE(HYPRE_IJVectorCreate(m->comm, p->first, p->last, &v->ij));
    HYPRE(HYPRE_IJVectorSetObjectType(v->ij, HYPRE_PARCSR));
    HYPRE(HYPRE_IJVectorInitialize(v->ij));
    HYPRE(HYPRE_IJVectorAssemble(v->ij));
    HYPRE(HYPRE_IJVectorGetObject(v->ij, (void **)&v->v));
}

static void set_vector(struct mesh_pressure *p, struct vector *v, const double *values)
{
    if (p->n > 0)
        HYPRE(HYPRE_IJVectorSetValues(v->ij, p->n, p->row, values));
}

static void get_vector(struct mesh_pressure *p, struct vector *v, double *values)
{
    if (p->n > 0)
        HYPRE(HYPRE_IJVectorGetValues(v->ij, p->n, p->row, values));
}

static HYPRE_ParCSRMatrix matrix_of(const struct mesh_pressure *p)
{
    return p->singular ? p->solved.A : p->whole.A;
}

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
    return amg;
}

/* In place of a setup: the hierarchy of a matrix before serves a neighbour; its cycle has the new
 * one on the finest level. */
static HYPRE_Int keep_hierarchy(HYPRE_Solver amg, HYPRE_Matrix A, HYPRE_Vector b, HYPRE_Vector x)
{
    (void)amg;
    (void)A;
    (void)b;
    (void)x;
    return 0;
}

static void make_gmres(const struct mesh *m, struct mesh_pressure *p, HYPRE_PtrToSolverFcn setup)
{
    HYPRE(HYPRE_ParCSRGMRESCreate(m->comm, &p->gmres));
    HYPRE(HYPRE_GMRESSetKDim(p->gmres, 30));
    HYPRE(HYPRE_GMRESSetMaxIter(p->gmres, 60));
    HYPRE(
        HYPRE_GMRESSetPrecond(p->gmres, (HYPRE_PtrToSolverFcn)HYPRE_BoomerAMGSolve, setup, p->amg));
    HYPRE(HYPRE_ParCSRGMRESSetup(p->gmres, matrix_of(p), p->b.v, p->x.v));
}

static void make_solver(const struct mesh *m, struct mesh_pressure *p)
{
    p->amg = make_amg(3, 1, 8);
    make_gmres(m, p, (HYPRE_PtrToSolverFcn)HYPRE_BoomerAMGSetup);
}

static void make_safe(const struct mesh *m, struct mesh_pressure *p)
{
    p->safe_amg = make_amg(6, 2, 6);
    HYPRE(HYPRE_ParCSRBiCGSTABCreate(m->comm, &p->safe));
    HYPRE(HYPRE_BiCGSTABSetMaxIter(p->safe, 300));
    HYPRE(HYPRE_BiCGSTABSetPrecond(p->safe, (HYPRE_PtrToSolverFcn)HYPRE_BoomerAMGSolve,
                                   (HYPRE_PtrToSolverFcn)HYPRE_BoomerAMGSetup, p->safe_amg));
    HYPRE(HYPRE_ParCSRBiCGSTABSetup(p->safe, matrix_of(p), p->b.v, p->x.v));
}

/* r = b - A x, its largest norm told by sum of squares; r stays in p->residual. */
static double residual(struct fv *s, struct mesh_pressure *p, HYPRE_ParCSRMatrix A, const double *b)
{
    double sum = 0.0;
    HYPRE(HYPRE_ParCSRMatrixMatvec(1.0, A, p->x.v, 0.0, p->r.v));
    get_vector(p, &p->r, p->residual);
    for (int k = 0; k < p->n; k++) {
        p->residual[k] = b[k] - p->residual[k];
        sum += p->residual[k] * p->residual[k];
    }
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->m->comm);
    return sqrt(sum);
}

static double norm(struct fv *s, const double *b, int n)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++)
        sum += b[k] * b[k];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->m->comm);
    return sqrt(sum);
}

/* What rounding leaves of A x: no solver gets below it. */
static double rounding(struct fv *s, struct mesh_pressure *p)
{
    get_vector(p, &p->x, p->residual);
    return 1e-15 * p->fringe * norm(s, p->residual, p->n);
}

/* Solves for the right side b (its pinned row counts as 0), x from its start; false: not. */
static bool solve(struct fv *s, struct mesh_pressure *p, double *b, double tol)
{
    HYPRE_Int its = 0;
    if (p->pinned >= p->first && p->pinned <= p->last)
        b[p->pinned - p->first] = 0.0;
    const double wanted = tol * norm(s, b, p->n);
    set_vector(p, &p->b, b);
    HYPRE(HYPRE_GMRESSetTol(p->gmres, tol));
    HYPRE(HYPRE_ParCSRGMRESSolve(p->gmres, matrix_of(p), p->b.v, p->x.v));
    HYPRE(HYPRE_GMRESGetNumIterations(p->gmres, &its));
    s->iterations += its;
    const double left = residual(s, p, matrix_of(p), b);
    if (left <= 2.0 * wanted || left <= rounding(s, p))
        return true;
    if (!p->safe)
        make_safe(s->m, p);
    s->retries++;
    HYPRE(HYPRE_BiCGSTABSetTol(p->safe, tol));
    HYPRE(HYPRE_ParCSRBiCGSTABSolve(p->safe, matrix_of(p), p->b.v, p->x.v));
    HYPRE(HYPRE_BiCGSTABGetNumIterations(p->safe, &its));
    s->iterations += its;
    return residual(s, p, matrix_of(p), b) <= 10.0 * wanted;
}

/* What the last residual has in the replaced row, on all ranks. */
static double pinned_residual(struct fv *s, struct mesh_pressure *p, const double *b)
{
    double v = 0.0;
    residual(s, p, p->whole.A, b);
    if (p->pinned >= p->first && p->pinned <= p->last)
        v = p->residual[p->pinned - p->first];
    MPI_Allreduce(MPI_IN_PLACE, &v, 1, MPI_DOUBLE, MPI_SUM, s->m->comm);
    return v;
}

/* c V is no larger than the right side it is taken out of, so z_w needs a tenth of the finest
 * tolerance of the run: the start's, see mesh_state_start; of blocks that move, which find it each
 * step, that of a step. */
static void solve_volumes(struct fv *s, struct mesh_pressure *p)
{
    double *b = NEW(double, p->n);
    const double tol = (s->m->moves ? 1e-2 : 1e-4) * fmin(1.0, s->prm.tol_pressure);
    memcpy(b, p->volume, (size_t)p->n * sizeof(double));
    set_vector(p, &p->x, p->zw);
    if (!solve(s, p, b, tol) && !(residual(s, p, matrix_of(p), b) < 1e-6 * norm(s, b, p->n)))
        fail("the pressure matrix of the blocks cannot be solved");
    get_vector(p, &p->x, p->zw);
    p->cw = pinned_residual(s, p, p->volume);
    mem_free(b);
}

static void set_volumes(const struct fv *s, struct mesh_pressure *p)
{
    p->volumes = 0.0;
    for (int k = 0; k < p->n; k++) {
        p->volume[k] = s->free[p->place[k]] * s->m->V[p->place[k]];
        p->volumes += p->volume[k];
    }
    MPI_Allreduce(MPI_IN_PLACE, &p->volumes, 1, MPI_DOUBLE, MPI_SUM, s->m->comm);
}

void mesh_pressure_create(struct fv *s)
{
    const struct mesh *m = s->m;
    struct mesh_pressure *p = s->poisson = NEW(struct mesh_pressure, 1);
    int64_t first, n;
    mesh_rows(m, m->rank, &first, &n);
    p->n = (int)n;
    p->first = (HYPRE_BigInt)first;
    p->last = (HYPRE_BigInt)(first + n - 1);
    p->singular = !mesh_bc_pressure_given(s);
    p->place = NEW(int64_t, n);
    p->row = NEW(HYPRE_BigInt, n);
    p->value = NEW(double, n);
    p->residual = NEW(double, n);
    p->volume = NEW(double, n);
    p->zw = NEW(double, n);
    if (m->moves)
        fill_anew(s, p);
    else
        fill_matrices(s, p);
    create_vector(m, p, &p->b);
    create_vector(m, p, &p->x);
    create_vector(m, p, &p->r);
    make_solver(m, p);
    set_volumes(s, p);
    if (p->singular)
        solve_volumes(s, p);
}

static void free_matrix(struct matrix *A)
{
    if (A->ij)
        HYPRE_IJMatrixDestroy(A->ij);
    A->ij = NULL;
}

static void free_safe(struct mesh_pressure *p)
{
    if (!p->safe)
        return;
    HYPRE_ParCSRBiCGSTABDestroy(p->safe);
    HYPRE_BoomerAMGDestroy(p->safe_amg);
    p->safe = NULL;
}

void mesh_pressure_renew(struct fv *s, bool hierarchy)
{
    struct mesh_pressure *p = s->poisson;
    free_safe(p);
    HYPRE_ParCSRGMRESDestroy(p->gmres);
    free_matrix(&p->whole);
    free_matrix(&p->solved);
    fill_anew(s, p);
    if (hierarchy) {
        HYPRE_BoomerAMGDestroy(p->amg);
        make_solver(s->m, p);
    } else
        make_gmres(s->m, p, keep_hierarchy);
    set_volumes(s, p);
    if (!p->singular)
        return;
    for (int k = 0; k < p->n; k++)
        p->zw[k] = s->zw[p->place[k]];
    solve_volumes(s, p);
    for (int k = 0; k < p->n; k++)
        s->zw[p->place[k]] = p->zw[k];
}

void mesh_pressure_free(struct mesh_pressure **pp)
{
    struct mesh_pressure *p = *pp;
    if (!p)
        return;
    HYPRE_ParCSRGMRESDestroy(p->gmres);
    HYPRE_BoomerAMGDestroy(p->amg);
    free_safe(p);
    free_matrix(&p->whole);
    free_matrix(&p->solved);
    HYPRE_IJVectorDestroy(p->b.ij);
    HYPRE_IJVectorDestroy(p->x.ij);
    HYPRE_IJVectorDestroy(p->r.ij);
    mem_free(p->place);
    mem_free(p->row);
    mem_free(p->value);
    mem_free(p->residual);
    mem_free(p->volume);
    mem_free(p->zw);
    mem_free(p->row_first);
    mem_free(p->row_col);
    mem_free(p->row_value);
    mem_free(p);
    *pp = NULL;
}

/* Mean over the computed volumes. */
static double mean(struct fv *s, const struct mesh_pressure *p, const double *z)
{
    double sum = 0.0;
    for (int k = 0; k < p->n; k++)
        sum += p->volume[k] * z[k];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->m->comm);
    return sum / p->volumes;
}

/* What rounding makes of divergences: nothing to solve for. */
static bool negligible(struct fv *s, const struct mesh_pressure *p, const double *div)
{
    double sum[2] = {0.0, 0.0};
    for (int k = 0; k < p->n; k++) {
        const int64_t c = p->place[k];
        sum[0] += div[c] * div[c];
        for (int a = 0; a < s->m->dim; a++)
            sum[1] += s->free[c] * s->U[a][c] * s->U[a][c];
        if (s->jump && s->m->status[c] == CELL_FRINGE && s->jump[c] != 0.0)
            sum[0] = INFINITY;
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->m->comm);
    return sum[0] <= 1e-27 * sum[1];
}

bool mesh_pressure_solve(struct fv *s, double tau, const double *div, double tol, double *start,
                         double *psi)
{
    struct mesh_pressure *p = s->poisson;
    double *b = p->value, c = 0.0;
    memset(psi, 0, (size_t)s->m->size_local * sizeof(double));
    if (negligible(s, p, div))
        return true;
    for (int k = 0; k < p->n; k++) {
        p->residual[k] = start[p->place[k]];
        b[k] = -div[p->place[k]] / tau;
        if (s->jump && s->m->status[p->place[k]] == CELL_FRINGE)
            b[k] = p->fringe * s->jump[p->place[k]];
    }
    set_vector(p, &p->x, p->residual);
    double keep = p->pinned >= p->first && p->pinned <= p->last ? b[p->pinned - p->first] : 0.0;
    const bool good = solve(s, p, b, tol);
    if (p->singular) {
        if (p->pinned >= p->first && p->pinned <= p->last)
            b[p->pinned - p->first] = keep;
        c = pinned_residual(s, p, b) / p->cw;
    }
    get_vector(p, &p->x, p->residual);
    for (int k = 0; k < p->n; k++) {
        start[p->place[k]] = p->residual[k];
        p->residual[k] -= c * p->zw[k];
    }
    const double level = p->singular ? mean(s, p, p->residual) : 0.0;
    for (int k = 0; k < p->n; k++)
        if (s->m->status[p->place[k]] != CELL_HOLE)
            psi[p->place[k]] = p->residual[k] - level;
    s->defect_now = fabs(c) * tau * p->volumes;
    return good;
}

/* The pinned row is solved for nothing: the mean goes out before and after. */
void mesh_pressure_cycle(struct fv *s, const double *div, double *psi)
{
    struct mesh_pressure *p = s->poisson;
    double excess = 0.0;
    for (int k = 0; k < p->n; k++)
        excess += p->volume[k] > 0.0 ? div[p->place[k]] : 0.0;
    MPI_Allreduce(MPI_IN_PLACE, &excess, 1, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < p->n; k++) {
        p->value[k] = p->volume[k] > 0.0 ? div[p->place[k]] : 0.0;
        p->value[k] -= p->singular ? excess * p->volume[k] / p->volumes : 0.0;
        p->residual[k] = 0.0;
    }
    if (p->pinned >= p->first && p->pinned <= p->last)
        p->value[p->pinned - p->first] = 0.0;
    set_vector(p, &p->b, p->value);
    set_vector(p, &p->x, p->residual);
    HYPRE(HYPRE_BoomerAMGSolve(p->amg, matrix_of(p), p->b.v, p->x.v));
    get_vector(p, &p->x, p->residual);
    const double level = p->singular ? mean(s, p, p->residual) : 0.0;
    memset(psi, 0, (size_t)s->size * sizeof(double));
    for (int k = 0; k < p->n; k++)
        if (s->m->status[p->place[k]] != CELL_HOLE)
            psi[p->place[k]] = p->residual[k] - level;
}
