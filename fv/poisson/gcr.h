/* gcr.h - generalised conjugate residuals with any preconditioner, for matrices that need not be
 * symmetric (Eisenstat, Elman & Schultz, SIAM J. Numer. Anal. 20, 1983).
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>
#include <stdbool.h>

enum { GCR_KEPT = 30 }; /* directions that a new one is made conjugate to */

/* A solver for one matrix; apply and cycle are called with `of'. */
struct gcr {
    MPI_Comm comm;
    int n; /* rows of this rank */
    /* Set after gcr_create: residuals are made orthogonal to the directions, not to their images.
     * Where A is symmetric this is conjugate gradients, whose error in psi is the smaller one; A
     * must be positive. */
    bool galerkin;
    void *of; /* borrowed: what apply and cycle are called with */
    void (*apply)(void *of, double *x, double *Ax);
    void (*cycle)(void *of, double *r, double *z);          /* z ~ A^-1 r */
    double *r, *z[GCR_KEPT], *Az[GCR_KEPT], kept[GCR_KEPT]; /* directions, images, their squares */
};

/* Sets *g for n rows on this rank; memory for directions is allocated when they are needed. They
 * belong to `owner'. */
void gcr_create(void *owner, struct gcr *g, MPI_Comm comm, int n, void *of,
                void (*apply)(void *of, double *x, double *Ax),
                void (*cycle)(void *of, double *r, double *z));
/* Solves A x = b starting from x, with at least one cycle unless `most' is 0 or the residual
 * vanishes, until |b - A x| <= goal, in at most `most' cycles. Returns their number; *left: the
 * norm of the residual in the end, which is in g->r. Collective. */
int gcr_solve(struct gcr *g, const double *b, double *x, double goal, int most, double *left);
/* Euclidean norm over all ranks. Collective. */
double gcr_norm(const struct gcr *g, const double *x);
