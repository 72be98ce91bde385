/* backend.h - who solves for the pressure: PFMG on even cells and rows, BoomerAMG under a surface
 * of blocks, both by fields; PFMG or BoomerAMG on other blocks, by vectors of this rank's rows: one
 * a cell of its parts, in their order, x fastest. A: minus the sum of the fluxes of psi out of a
 * computed cell. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_BACKEND_H
#define FV_BACKEND_H

#include <stdbool.h>
#include <stdint.h>

struct fv;

struct backend {
    const char *name;
    /* NULL: it cannot take these cells. */
    void *(*create)(struct fv *s);
    void (*free)(void **of);
    /* By fields, see poisson_solve, poisson_cycle; NULL: by rows. */
    bool (*solve_field)(struct fv *s, double tau, double *div, double tol, double *psi);
    void (*cycle_field)(struct fv *s, double *div, double *psi);
    /* A psi = b - c V (of cells of the fringe: psi = I psi + b) of all computed volumes V; c is 0
     * where a side gives the pressure. x: start, then that of the next solve. false: did not
     * converge. */
    bool (*solve)(struct fv *s, void *of, double *b, double tol, double *x, double *psi, double *c);
    /* Of the solves of stages and of the last one of a step, over what the step wants: the residual
     * says little about waves as long as the grid, which make forces and p; a cycle of PFMG takes
     * all waves alike. */
    double stage, last;
    /* x ~ (A + shift V)^-1 b by one cycle, a linear map; without a shift b has no mean if no side
     * gives the pressure. */
    void (*cycle)(struct fv *s, void *of, double *b, double *x);
    /* See poisson.h; NULL: it is never called for. */
    void (*shift)(struct fv *s, void *of, double shift);
    void (*rebuild)(struct fv *s, void *of);
    void (*renew)(struct fv *s, void *of, bool hierarchy);
};

extern const struct backend backend_even;      /* pressure.c */
extern const struct backend backend_wet;       /* wet_pressure.c */
extern const struct backend backend_pfmg;      /* tiles.c: blocks that make one index space */
extern const struct backend backend_boomeramg; /* mesh_pressure.c: all others */

struct poisson {
    const struct backend *by;
    void *of; /* its own */
    /* of blocks: */
    int n, first;   /* rows of this rank; number of the first among all */
    int64_t *place; /* of each */
    double *V;      /* m^dim: of computed cells, else 0 */
    double volumes; /* m^dim: of all computed cells */
    double shift;
    double *b, *x, *psi;
};

#endif
