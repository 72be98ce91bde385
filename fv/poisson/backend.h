/* backend.h - the solvers of the pressure equation: PFMG on uniform cells and layers, BoomerAMG
 * under a surface of blocks, both on fields; PFMG or BoomerAMG on other blocks, on vectors of this
 * rank's matrix rows: one row per cell of its parts, in their order, x fastest. A: minus the sum of
 * the fluxes of psi out of a computed cell.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdint.h>

struct fv;

/* A solver as functions; `of' is the state that create made. */
struct backend {
    /* A block of mem.h, freed by FREE with all that it owns; NULL: it cannot take these cells. */
    void *(*create)(struct fv *s);
    /* On fields, see poisson_solve and poisson_cycle; NULL: it works on vectors. */
    bool (*solve_field)(struct fv *s, double tau, double *div, double tol, double *psi);
    void (*cycle_field)(struct fv *s, double *div, double *psi);
    /* Solves A psi = b - c V (in cells of the fringe: psi = I psi + b), V the volumes of computed
     * cells; c is 0 where a side gives the pressure. x: start, then that of the next solve. false:
     * not converged. */
    bool (*solve)(struct fv *s, void *of, double *b, double tol, double *x, double *psi, double *c);
    /* Factors on the tolerance of the step, for the solves of its stages and for the last one. The
     * residual says little about waves as long as the grid, which make forces and p; a cycle of
     * PFMG reduces all waves alike. */
    double stage, last;
    /* x ~ (A + shift V)^-1 b by one cycle, a linear map; without a shift b has no mean unless a
     * side gives the pressure. */
    void (*cycle)(struct fv *s, void *of, double *b, double *x);
    /* NULL: a cycle knows no shift, and serves as a preconditioner without it. */
    void (*shift)(struct fv *s, void *of, double shift);
    /* Those of poisson.h; NULL: never called for these cells. */
    void (*rebuild)(struct fv *s, void *of);
    void (*renew)(struct fv *s, void *of, bool hierarchy);
};

extern const struct backend backend_even;      /* pressure.c */
extern const struct backend backend_wet;       /* wet_pressure.c */
extern const struct backend backend_pfmg;      /* tiles.c: blocks that make one index space */
extern const struct backend backend_boomeramg; /* mesh_pressure.c: all others */

/* The solver in use with its vectors; s->poisson. */
struct poisson {
    const struct backend *by;
    void *of; /* its own */
    /* Of blocks: rows of this rank; number of the first among all ranks'. */
    int n, first;
    int64_t *place; /* [n] index of the row's cell in a field */
    double *V;      /* m^dim: of computed cells, else 0 */
    double volumes; /* m^dim: of all computed cells */
    double shift;
    double *b, *x, *psi;
};
