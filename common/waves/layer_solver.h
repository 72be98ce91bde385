/* layer_solver.h - inside of layer.h: its flat operator mode by mode, and GMRES.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_LAYER_SOLVER_H
#define COMMON_LAYER_SOLVER_H

#include <stddef.h>

struct sigma_layer;

enum { LAYER_VECTORS = 40, LAYER_RESTARTS = 3 };

struct layer_solver {
    double *D1, *D2;     /* [nodes][rows], transposed: derivatives along sigma and twice */
    double *lower;       /* 1/m, [cells]: K of each mode */
    int kinds;           /* sizes of modes whose flat operator is kept; a mode takes the nearest */
    double kind;         /* 1/m: from one to the next; along a line each mode has its own */
    double *inverse;     /* [kinds][rows][rows] */
    int batch, at_lower; /* of level: values of a column; where K f stands */
    double *flat;        /* -, [kinds]: W on a flat surface over that of linear waves */
    double *packed, *work;  /* [cells][2][batch] */
    double *slopes, *level; /* f_x + i lap f, [cells][2][rows]; f + i f_y, [cells][2][batch] */
    double *start, *vectors[LAYER_VECTORS + 1]; /* [cells][rows]: preconditioned unknown */
};

/* y = A x of a transposed matrix [nodes][rows]. */
void layer_solver_multiply(const double *transposed, int nodes, int rows, const double *x,
                           double *restrict y);
/* Chebyshev's points sigma[nodes] in -1 .. 0 and derivatives along them, [nodes][rows]
 * transposed. */
void layer_solver_points(int nodes, int rows, double *sigma, double *D1, double *D2);
struct layer_solver *layer_solver_create(const struct sigma_layer *l, double depth);
void layer_solver_free(const struct sigma_layer *l, struct layer_solver **s);
/* From y the potential P^-1 y and its derivatives into slopes and level, as fields. */
void layer_solver_flat(struct sigma_layer *l, const double *y);
/* Ay = b to a residual of tolerance |b|; y: start, then solution. Products, -1: not converged. */
int layer_solver_gmres(struct sigma_layer *l, const double *b, double tolerance, double *y);
/* r = A P^-1 y, and what layer_solver_flat leaves. */
void layer_product(struct sigma_layer *l, const double *y, double *r);

#endif
