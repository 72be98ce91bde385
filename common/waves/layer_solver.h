/* layer_solver.h - the inside of layer.h: the operator of a flat surface, inverted mode by mode,
 * and GMRES preconditioned by it. For layer.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_LAYER_SOLVER_H
#define COMMON_LAYER_SOLVER_H

#include <stddef.h>

struct sigma_layer;

enum { LAYER_VECTORS = 40, LAYER_RESTARTS = 3 };

/* Operators and work arrays of one layer. */
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

/* y = A x for a matrix stored transposed, [nodes][rows]; rows beyond nodes are zeros. */
void layer_solver_multiply(const double *transposed, int nodes, int rows, const double *x,
                           double *restrict y);
/* The solver of a layer over water of `depth', m; owned by the layer. */
struct layer_solver *layer_solver_create(const struct sigma_layer *l, double depth);
/* From y the potential P^-1 y and its derivatives, as fields in slopes and level. P is the operator
 * of the flat surface. */
void layer_solver_flat(struct sigma_layer *l, const double *y);
/* Solves A P^-1 y = b to a residual of tolerance |b|; y is the start on entry. Returns the number
 * of products, -1: not converged. */
int layer_solver_gmres(struct sigma_layer *l, const double *b, double tolerance, double *y);
/* r = A P^-1 y; leaves slopes and level as layer_solver_flat does. */
void layer_product(struct sigma_layer *l, const double *y, double *r);

#endif
