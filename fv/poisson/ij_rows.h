/* ij_rows.h - rows and vectors of matrices of hypre's IJ interface.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_IJ_ROWS_H
#define FV_IJ_ROWS_H

#include <HYPRE_IJ_mv.h>

#include "../../common/log.h"
#include "hypre_call.h"

enum { ROW_MAX = 96 };

/* A row under way. */
struct row {
    int n;
    HYPRE_BigInt col[ROW_MAX];
    double v[ROW_MAX];
};

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

struct vector {
    HYPRE_IJVector ij;
    HYPRE_ParVector v;
    int n; /* rows of this rank */
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

#endif
