/* ij_rows.h - matrices and vectors of hypre's IJ interface over n rows of each rank, of which the
 * first has a number among all. All calls that create or assemble are collective over comm.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <HYPRE_IJ_mv.h>

#include "../../common/base/base.h"
#include "../fv.h"
#include "backend.h"
#include "hypre_call.h"

/* The most entries of a row; more end the run. */
enum { ROW_MAX = 96 };

/* A matrix row under construction. */
struct row {
    int n;
    HYPRE_BigInt col[ROW_MAX];
    double v[ROW_MAX];
};

/* Adds v to the entry in column col of the row. */
static inline void row_add(struct row *r, HYPRE_BigInt col, double v)
{
    for (int k = 0; k < r->n; k++)
        if (r->col[k] == col) {
            r->v[k] += v;
            return;
        }
    require(r->n < ROW_MAX && col >= 0);
    r->col[r->n] = col;
    r->v[r->n++] = v;
}

/* A matrix; A belongs to ij. matrix_free frees both. */
struct matrix {
    HYPRE_IJMatrix ij;
    HYPRE_ParCSRMatrix A;
};

/* Makes the matrix from ncols[n] entries of each row, one row behind the other in col and v. */
static inline void matrix_create(struct matrix *A, MPI_Comm comm, HYPRE_BigInt first, int n,
                                 HYPRE_Int *ncols, const HYPRE_BigInt *col, const double *v)
{
    const HYPRE_BigInt last = first + n - 1;
    HYPRE_BigInt *row = NEW(HYPRE_BigInt, n);
    for (int k = 0; k < n; k++)
        row[k] = first + k;
    HYPRE(HYPRE_IJMatrixCreate(comm, first, last, first, last, &A->ij));
    HYPRE(HYPRE_IJMatrixSetObjectType(A->ij, HYPRE_PARCSR));
    HYPRE(HYPRE_IJMatrixSetRowSizes(A->ij, ncols));
    HYPRE(HYPRE_IJMatrixInitialize(A->ij));
    if (n > 0)
        HYPRE(HYPRE_IJMatrixSetValues(A->ij, n, ncols, row, col, v));
    HYPRE(HYPRE_IJMatrixAssemble(A->ij));
    HYPRE(HYPRE_IJMatrixGetObject(A->ij, (void **)&A->A));
    mem_free(row);
}

static inline void matrix_free(struct matrix *A)
{
    if (A->ij)
        HYPRE_IJMatrixDestroy(A->ij);
    A->ij = NULL;
}

/* A distributed vector of the n rows of this rank. */
struct vector {
    HYPRE_IJVector ij;
    HYPRE_ParVector v;
    int n;
};

static inline void vector_create(struct vector *v, MPI_Comm comm, HYPRE_BigInt first, int n)
{
    v->n = n;
    HYPRE(HYPRE_IJVectorCreate(comm, first, first + n - 1, &v->ij));
    HYPRE(HYPRE_IJVectorSetObjectType(v->ij, HYPRE_PARCSR));
    HYPRE(HYPRE_IJVectorInitialize(v->ij));
    HYPRE(HYPRE_IJVectorAssemble(v->ij));
    HYPRE(HYPRE_IJVectorGetObject(v->ij, (void **)&v->v));
}

static inline void vector_free(struct vector *v)
{
    if (v->ij)
        HYPRE_IJVectorDestroy(v->ij);
    v->ij = NULL;
}

static inline void vector_set(struct vector *v, const double *values)
{
    if (v->n > 0)
        HYPRE(HYPRE_IJVectorSetValues(v->ij, v->n, NULL, values)); /* NULL: all, in order */
}

static inline void vector_get(struct vector *v, double *values)
{
    if (v->n > 0)
        HYPRE(HYPRE_IJVectorGetValues(v->ij, v->n, NULL, values));
}
