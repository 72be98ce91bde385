/* gcr.h - conjugate residuals with any preconditioner, for matrices that need not be symmetric.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_GCR_H
#define FV_GCR_H

#include <mpi.h>
#include <stdbool.h>

enum { GCR_KEPT = 30 }; /* directions that a new one is made conjugate to */

struct gcr {
    MPI_Comm comm;
    int n; /* rows of this rank */
    /* Residuals are made orthogonal to the directions, not to their images: where A is symmetric,
     * conjugate gradients, whose error in psi is the smaller one; A must be positive. */
    bool galerkin;
    void *of; /* borrowed: what apply and cycle are called with */
    void (*apply)(void *of, double *x, double *Ax);
    void (*cycle)(void *of, double *r, double *z);          /* z ~ A^-1 r */
    double *r, *z[GCR_KEPT], *Az[GCR_KEPT], kept[GCR_KEPT]; /* directions, images, their squares */
};

/* Room for directions is made when they are needed. */
void gcr_create(struct gcr *g, MPI_Comm comm, int n, void *of,
                void (*apply)(void *of, double *x, double *Ax),
                void (*cycle)(void *of, double *r, double *z));
void gcr_free(struct gcr *g);
/* A x = b from x on, at least one cycle if most allows it, until |b - A x| <= goal, at most `most'
 * cycles. Returns their number. left: the norm of the residual in the end, which is in g->r. */
int gcr_solve(struct gcr *g, const double *b, double *x, double goal, int most, double *left);
double gcr_norm(const struct gcr *g, const double *x);

#endif
