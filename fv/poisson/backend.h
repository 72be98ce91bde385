/* backend.h - who solves for the pressure of blocks. All work on vectors of this rank's rows: one a
 * cell of its parts, in their order, x fastest. A: minus the sum of the fluxes of psi out of a
 * computed cell. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_BACKEND_H
#define FV_BACKEND_H

#include <stdbool.h>

struct fv;

struct backend {
    const char *name;
    /* Of the solves of stages and of the last one of a step, over what the step wants: the residual
     * says little about waves as long as the grid, which make forces and p; a cycle of PFMG takes
     * all waves alike. */
    double stage, last;
    /* NULL: it cannot take these blocks. */
    void *(*create)(struct fv *s);
    void (*free)(void **of);
    /* A psi = b - c V (of cells of the fringe: psi = I psi + b) of all computed volumes V; c is 0
     * where a side gives the pressure. x: start, then that of the next solve. false: did not
     * converge. */
    bool (*solve)(struct fv *s, void *of, double *b, double tol, double *x, double *psi, double *c);
    /* x ~ (A + shift V)^-1 b by one cycle, a linear map; without a shift b has no mean if no side
     * gives the pressure. */
    void (*cycle)(struct fv *s, void *of, double *b, double *x);
    /* 1/m^2; 0 at the start. */
    void (*shift)(struct fv *s, void *of, double shift);
    /* After blocks have moved, see poisson_renew; NULL: theirs never do. */
    void (*renew)(struct fv *s, void *of, bool hierarchy);
};

extern const struct backend backend_pfmg;      /* tiles.c: blocks that make one index space */
extern const struct backend backend_boomeramg; /* mesh_pressure.c: all others */

#endif
