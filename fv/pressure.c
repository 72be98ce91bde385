/* pressure.c - see pressure.h. Settings of PFMG: red-black relaxation with non-Galerkin coarse
 * operators, 5-point on all levels; this pair and no wider stencil (README.md).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "pressure.h"

#include <HYPRE_struct_ls.h>
#include <string.h>

#include "../common/log.h"
#include "../common/mem.h"
#include "forcing.h"

/* hypre or-s all errors into one flag; "not converged" is the caller's to judge. */
#define HYPRE(call)                                                                                \
    do {                                                                                           \
        (void)(call);                                                                              \
        HYPRE_ClearError(HYPRE_ERROR_CONV);                                                        \
        if (HYPRE_GetError())                                                                      \
            fail("%s: hypre error %d", #call, (int)HYPRE_GetError());                              \
    } while (0)

struct pressure {
    HYPRE_StructGrid grid;
    HYPRE_StructStencil stencil;
    HYPRE_StructMatrix A;
    HYPRE_StructVector b, x;
    HYPRE_StructSolver pcg, pfmg;
    int lo[3], hi[3];
    double *packed;
    int64_t n;
};

static void make_grid(const struct block *b, struct pressure *p)
{
    int periodic[3] = {0, 0, 0};
    HYPRE(HYPRE_StructGridCreate(b->cart, b->dim, &p->grid));
    p->n = 1;
    for (int a = 0; a < 3; a++) {
        p->lo[a] = b->lo[a];
        p->hi[a] = b->hi[a] - 1;
        p->n *= b->n[a];
        periodic[a] = b->periodic[a] ? b->cells[a] : 0;
    }
    HYPRE(HYPRE_StructGridSetExtents(p->grid, p->lo, p->hi));
    HYPRE(HYPRE_StructGridSetPeriodic(p->grid, periodic));
    HYPRE(HYPRE_StructGridAssemble(p->grid));
    HYPRE(HYPRE_StructStencilCreate(b->dim, 2 * b->dim + 1, &p->stencil));
    for (int e = 0; e <= 2 * b->dim; e++) {
        int offset[3] = {0, 0, 0};
        if (e > 0)
            offset[(e - 1) / 2] = (e - 1) % 2 ? 1 : -1;
        HYPRE(HYPRE_StructStencilSetElement(p->stencil, e, offset));
    }
}

/* Row of a cell, -Lap: what is open passes, forced cells stand alone. */
static void fill_row(const struct fv *s, int64_t c, double *row)
{
    const struct block *b = &s->b;
    const struct forcing *f = s->forcing;
    row[0] = 0.0;
    for (int e = 1; e <= 2 * b->dim; e++) {
        const int a = (e - 1) / 2;
        const int64_t face = (e - 1) % 2 ? c + b->stride[a] : c;
        const double w = (f ? f->open[a][face] : 1.0) / (b->h[a] * b->h[a]);
        row[e] = -w;
        row[0] += w;
    }
    if (row[0] == 0.0) /* forced, or free and shut in */
        row[0] = 1.0;
}

static void make_matrix(const struct fv *s, struct pressure *p)
{
    const struct block *b = &s->b;
    const int m = 2 * b->dim + 1;
    int entries[7] = {0, 1, 2, 3, 4, 5, 6};
    double *values = NEW(double, p->n *m), *row = values;
    for (int k = 0; k < b->n[2]; k++)
        for (int j = 0; j < b->n[1]; j++)
            for (int i = 0; i < b->n[0]; i++, row += m)
                fill_row(s, block_at(b, i, j, k), row);
    HYPRE(HYPRE_StructMatrixCreate(b->cart, p->grid, p->stencil, &p->A));
    HYPRE(HYPRE_StructMatrixInitialize(p->A));
    HYPRE(HYPRE_StructMatrixSetBoxValues(p->A, p->lo, p->hi, m, entries, values));
    HYPRE(HYPRE_StructMatrixAssemble(p->A));
    mem_free(values);
}

static void make_solver(const struct block *b, struct pressure *p)
{
    HYPRE(HYPRE_StructPFMGCreate(b->cart, &p->pfmg));
    HYPRE(HYPRE_StructPFMGSetMaxIter(p->pfmg, 1));
    HYPRE(HYPRE_StructPFMGSetTol(p->pfmg, 0.0));
    HYPRE(HYPRE_StructPFMGSetZeroGuess(p->pfmg));
    HYPRE(HYPRE_StructPFMGSetRelaxType(p->pfmg, 2));
    HYPRE(HYPRE_StructPFMGSetRAPType(p->pfmg, 1));
    HYPRE(HYPRE_StructPFMGSetSkipRelax(p->pfmg, 1));
    HYPRE(HYPRE_StructPFMGSetNumPreRelax(p->pfmg, 1));
    HYPRE(HYPRE_StructPFMGSetNumPostRelax(p->pfmg, 1));
    HYPRE(HYPRE_StructPCGCreate(b->cart, &p->pcg));
    HYPRE(HYPRE_StructPCGSetTwoNorm(p->pcg, 1));
    HYPRE(HYPRE_StructPCGSetPrecond(p->pcg, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, p->pfmg));
    HYPRE(HYPRE_StructPCGSetup(p->pcg, p->A, p->b, p->x));
}

struct pressure *pressure_create(const struct fv *s)
{
    const struct block *b = &s->b;
    struct pressure *p = NEW(struct pressure, 1);
    make_grid(b, p);
    make_matrix(s, p);
    p->packed = NEW(double, p->n);
    HYPRE(HYPRE_StructVectorCreate(b->cart, p->grid, &p->b));
    HYPRE(HYPRE_StructVectorInitialize(p->b));
    HYPRE(HYPRE_StructVectorCreate(b->cart, p->grid, &p->x));
    HYPRE(HYPRE_StructVectorInitialize(p->x));
    HYPRE(HYPRE_StructVectorSetBoxValues(p->b, p->lo, p->hi, p->packed));
    HYPRE(HYPRE_StructVectorSetBoxValues(p->x, p->lo, p->hi, p->packed));
    HYPRE(HYPRE_StructVectorAssemble(p->b));
    HYPRE(HYPRE_StructVectorAssemble(p->x));
    make_solver(b, p);
    return p;
}

void pressure_free(struct pressure **p)
{
    if (!*p)
        return;
    HYPRE_StructPCGDestroy((*p)->pcg);
    HYPRE_StructPFMGDestroy((*p)->pfmg);
    HYPRE_StructVectorDestroy((*p)->b);
    HYPRE_StructVectorDestroy((*p)->x);
    HYPRE_StructMatrixDestroy((*p)->A);
    HYPRE_StructStencilDestroy((*p)->stencil);
    HYPRE_StructGridDestroy((*p)->grid);
    mem_free((*p)->packed);
    mem_free(*p);
    *p = NULL;
}

/* Takes the mean out: the rows sum to zero, so must the right side. */
static void remove_mean(const struct fv *s, double *div)
{
    const struct block *b = &s->b;
    double sum = 0.0, n = s->forcing ? (double)s->forcing->free_cells : 1.0;
    if (s->forcing)
        forcing_zero(s->forcing, div);
    else
        for (int a = 0; a < b->dim; a++)
            n *= b->cells[a];
    BLOCK_ROWS (b, 0, c, m)
        for (int64_t i = c; i < c + m; i++)
            sum += div[i];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, b->cart);
    BLOCK_ROWS (b, 0, c, m)
        for (int64_t i = c; i < c + m; i++)
            div[i] = sum / n - div[i]; /* the operator is -Lap */
    if (s->forcing)
        forcing_zero(s->forcing, div);
}

int pressure_solve(const struct fv *s, double *psi, double *div, double tol, int most)
{
    struct pressure *p = s->pressure;
    int iterations;
    double *const fields[1] = {psi};
    remove_mean(s, div);
    if (s->forcing)
        forcing_zero(s->forcing, psi);
    block_pack(&s->b, div, p->packed);
    HYPRE(HYPRE_StructVectorSetBoxValues(p->b, p->lo, p->hi, p->packed));
    block_pack(&s->b, psi, p->packed);
    HYPRE(HYPRE_StructVectorSetBoxValues(p->x, p->lo, p->hi, p->packed));
    HYPRE(HYPRE_StructPCGSetTol(p->pcg, tol));
    HYPRE(HYPRE_StructPCGSetMaxIter(p->pcg, most));
    HYPRE(HYPRE_StructPCGSolve(p->pcg, p->A, p->b, p->x));
    HYPRE(HYPRE_StructPCGGetNumIterations(p->pcg, &iterations));
    HYPRE(HYPRE_StructVectorGetBoxValues(p->x, p->lo, p->hi, p->packed));
    block_unpack(&s->b, p->packed, psi);
    block_halo(&s->b, 1, fields);
    return iterations;
}
