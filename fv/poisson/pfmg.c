/* pfmg.c - see pfmg.h. Red-black relaxation with non-Galerkin coarse operators: this pair and no
 * wider stencil (METHODS.md). A cycle starts from zero and is one iteration of hypre's PFMG with
 * one relaxation before and one after the coarse grid; it is the preconditioner of the backends and
 * is set up anew whenever the matrix is (pfmg_set_matrix).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "pfmg.h"

#include <HYPRE_struct_ls.h>

#include "hypre_call.h"

struct pfmg {
    struct pfmg_grid of;
    HYPRE_StructGrid grid;
    HYPRE_StructStencil stencil;
    HYPRE_StructMatrix A;
    HYPRE_StructVector b, x;
    HYPRE_StructSolver cycle;
};

static void make_grid(struct pfmg *p)
{
    const struct pfmg_grid *g = &p->of;
    int periodic[3] = {0, 0, 0};
    HYPRE(HYPRE_StructGridCreate(g->comm, g->dim, &p->grid));
    for (int a = 0; a < 3; a++)
        periodic[a] = g->periodic[a] ? g->cells[a] : 0;
    for (int k = 0; k < g->nboxes; k++)
        HYPRE(HYPRE_StructGridSetExtents(p->grid, g->lo[k], g->hi[k]));
    HYPRE(HYPRE_StructGridSetPeriodic(p->grid, periodic));
    HYPRE(HYPRE_StructGridAssemble(p->grid));
    HYPRE(HYPRE_StructStencilCreate(g->dim, 2 * g->dim + 1, &p->stencil));
    for (int e = 0; e <= 2 * g->dim; e++) {
        int offset[3] = {0, 0, 0};
        if (e > 0)
            offset[(e - 1) / 2] = (e - 1) % 2 ? 1 : -1;
        HYPRE(HYPRE_StructStencilSetElement(p->stencil, e, offset));
    }
}

/* Values are set box by box before each solve. */
static void make_vector(struct pfmg *p, HYPRE_StructVector *v)
{
    HYPRE(HYPRE_StructVectorCreate(p->of.comm, p->grid, v));
    HYPRE(HYPRE_StructVectorInitialize(*v));
    HYPRE(HYPRE_StructVectorAssemble(*v));
}

/* Levels of the cycle, which halves the axis of the least spacing: down to the first grid with an
 * odd number of cells along a periodic axis. There red cells have red neighbours, and a half sweep
 * would read what the last solve left; the last level is relaxed by Jacobi, which does not. Axes of
 * the same spacing go together: the grids between are not relaxed. */
static int levels(const struct pfmg_grid *g)
{
    int n[3] = {g->cells[0], g->cells[1], g->cells[2]}, count = 1;
    double h[3] = {g->h[0], g->h[1], g->h[2]};
    for (;;) {
        double least = INFINITY;
        for (int a = 0; a < g->dim; a++) {
            if (g->periodic[a] && n[a] > 1 && n[a] % 2)
                return count;
            least = n[a] > 1 ? fmin(least, h[a]) : least;
        }
        if (least == INFINITY)
            return count;
        for (int a = 0; a < g->dim; a++)
            if (n[a] > 1 && h[a] < 1.05 * least) {
                n[a] = (n[a] + 1) / 2;
                h[a] *= 2.0;
                count++;
            }
    }
}

/* Red-black in boxes with closed sides and in periodic ones of even sides; else weighted Jacobi:
 * the coarsest grids have one cell along a periodic axis and more along another then, a cell is its
 * own neighbour, and red and black again read what the last solve left. */
static int relaxation(const struct pfmg_grid *g)
{
    bool closed = true, even = true;
    for (int a = 0; a < g->dim; a++) {
        closed = closed && !g->periodic[a];
        even = even && g->periodic[a] && g->cells[a] == g->cells[0] &&
               fabs(g->h[a] / g->h[0] - 1.0) < 1e-9;
    }
    return closed || even ? 2 : 1;
}

static void make_cycle(struct pfmg *p)
{
    HYPRE(HYPRE_StructPFMGCreate(p->of.comm, &p->cycle));
    HYPRE(HYPRE_StructPFMGSetMaxIter(p->cycle, 1));
    HYPRE(HYPRE_StructPFMGSetTol(p->cycle, 0.0));
    HYPRE(HYPRE_StructPFMGSetZeroGuess(p->cycle));
    HYPRE(HYPRE_StructPFMGSetMaxLevels(p->cycle, levels(&p->of)));
    HYPRE(HYPRE_StructPFMGSetRelaxType(p->cycle, relaxation(&p->of)));
    HYPRE(HYPRE_StructPFMGSetRAPType(p->cycle, 1));
    HYPRE(HYPRE_StructPFMGSetSkipRelax(p->cycle, 1));
    HYPRE(HYPRE_StructPFMGSetNumPreRelax(p->cycle, 1));
    HYPRE(HYPRE_StructPFMGSetNumPostRelax(p->cycle, 1));
    if (p->of.uneven) /* which axis it halves would hang on the rows' scatter otherwise */
        HYPRE(HYPRE_StructPFMGSetDxyz(p->cycle, p->of.h));
    HYPRE(HYPRE_StructPFMGSetup(p->cycle, p->A, p->b, p->x));
}

/* The caller's are borrowed for the call alone. */
static void copy_boxes(void *owner, struct pfmg_grid *g)
{
    int(*const lo)[3] = g->lo, (*const hi)[3] = g->hi;
    const size_t bytes = (size_t)g->nboxes * sizeof *lo;
    g->lo = (int(*)[3])NEW_IN(owner, int, 3 * g->nboxes);
    g->hi = (int(*)[3])NEW_IN(owner, int, 3 * g->nboxes);
    memcpy(g->lo, lo, bytes);
    memcpy(g->hi, hi, bytes);
}

static void close_hypre(void *of)
{
    struct pfmg *p = of;
    if (p->A) {
        HYPRE_StructPFMGDestroy(p->cycle);
        HYPRE_StructMatrixDestroy(p->A);
    }
    HYPRE_StructVectorDestroy(p->b);
    HYPRE_StructVectorDestroy(p->x);
    HYPRE_StructStencilDestroy(p->stencil);
    HYPRE_StructGridDestroy(p->grid);
}

struct pfmg *pfmg_create(const struct pfmg_grid *g)
{
    struct pfmg *p = NEW(struct pfmg, 1);
    p->of = *g;
    copy_boxes(p, &p->of);
    make_grid(p);
    make_vector(p, &p->b);
    make_vector(p, &p->x);
    mem_at_free(p, close_hypre);
    return p;
}

void pfmg_set_matrix(struct pfmg *p, double *const *rows)
{
    const struct pfmg_grid *g = &p->of;
    int entries[7] = {0, 1, 2, 3, 4, 5, 6};
    if (p->A) {
        HYPRE_StructPFMGDestroy(p->cycle);
        HYPRE_StructMatrixDestroy(p->A);
    }
    HYPRE(HYPRE_StructMatrixCreate(g->comm, p->grid, p->stencil, &p->A));
    HYPRE(HYPRE_StructMatrixInitialize(p->A));
    for (int k = 0; k < g->nboxes; k++)
        HYPRE(HYPRE_StructMatrixSetBoxValues(p->A, g->lo[k], g->hi[k], 2 * g->dim + 1, entries,
                                             rows[k]));
    HYPRE(HYPRE_StructMatrixAssemble(p->A));
    make_cycle(p);
}

void pfmg_put(struct pfmg *p, int box, int outer[2][3], double *r)
{
    HYPRE(
        HYPRE_StructVectorSetBoxValues2(p->b, p->of.lo[box], p->of.hi[box], outer[0], outer[1], r));
}

void pfmg_get(struct pfmg *p, int box, int outer[2][3], double *x)
{
    HYPRE(
        HYPRE_StructVectorGetBoxValues2(p->x, p->of.lo[box], p->of.hi[box], outer[0], outer[1], x));
}

void pfmg_cycle(struct pfmg *p) { HYPRE(HYPRE_StructPFMGSolve(p->cycle, p->A, p->b, p->x)); }
