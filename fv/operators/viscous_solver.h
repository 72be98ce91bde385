/* viscous_solver.h - what the implicit viscous solve keeps from step to step: its scratch, and what
 * is known of the spectrum of its operator. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_VISCOUS_SOLVER_H
#define FV_VISCOUS_SOLVER_H

#include "../fv.h"

struct viscous_solver {
    double *work[4][3];  /* as struct helmholtz wants them; on uniform cells the last one borrows
                          * s->faces[0] and s->flux */
    double *scale;       /* 1/s, blocks: the rows' diagonal, of a step of c: 1 + c scale */
    double stiffest;     /* 1/s, blocks: mesh_viscous_largest; 0 without walls, where little is left
                          * to solve for */
    bool symmetric;      /* blocks: mesh_viscous_symmetric */
    double cells_a_side; /* the square or cubic root of how many there are */
};

/* NULL: no viscosity. The grid, its walls and what the cells are must be there. Collective. */
struct viscous_solver *viscous_solver_create(const struct fv *s);
void viscous_solver_free(struct fv *s);
/* Cells or walls have changed. Collective. */
void viscous_solver_renew(struct fv *s);
/* Its stiffest, 0 without viscosity. */
double viscous_stiffest(const struct fv *s);

#endif
