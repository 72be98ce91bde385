/* viscous_solver.h - what the implicit viscous solve keeps from step to step: its scratch, and what
 * is known of the spectrum of its operator. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_VISCOUS_SOLVER_H
#define FV_VISCOUS_SOLVER_H

#include "../fv.h"

/* s->viscous. Its arrays are owned. */
struct viscous_solver {
    double *work[4][3];  /* as struct helmholtz wants them; on uniform cells the last one borrows
                          * s->faces[0] and s->flux */
    float *single[3][3]; /* instead, on uniform cells between periodic sides: viscous_single.c */
    double *scale;       /* 1/s, blocks: the rows' diagonal, of a step of c: 1 + c scale */
    double stiffest;     /* 1/s, blocks: mesh_viscous_largest; 0 without walls, where little is left
                          * to solve for */
    bool symmetric;      /* blocks: mesh_viscous_symmetric */
    double cells_a_side; /* the square or cubic root of how many there are */
};

/* What the solve needs for the grid, its walls and the state of its cells, which must be there
 * before; owned by the caller (FREE). NULL: the fluid has no viscosity.
 * Collective. */
struct viscous_solver *viscous_solver_create(const struct fv *s);
/* Finds the spectrum anew after cells or walls have changed. Collective. */
void viscous_solver_renew(struct fv *s);
/* The member stiffest, 1/s; 0 without viscosity. */
double viscous_stiffest(const struct fv *s);

#endif
