/* mesh_pressure.h - the pressure of all blocks in one matrix. SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef FV_MESH_PRESSURE_H
#define FV_MESH_PRESSURE_H

#include "../fv.h"
#include "../grid/mesh.h"

/* mesh_pressure.c: A psi = -div/tau; div with what the overlap makes taken out evenly. */
void mesh_pressure_create(struct fv *s);
/* After blocks have moved: the matrix of the cells and of m->fringes now; without `hierarchy' the
 * one of a matrix before goes on as preconditioner. */
void mesh_pressure_renew(struct fv *s, bool hierarchy);
void mesh_pressure_free(struct mesh_pressure **p);
/* false: did not converge. start: kept for the next solve. */
bool mesh_pressure_solve(struct fv *s, double tau, const double *div, double tol, double *start,
                         double *psi);
/* psi ~ the solution of A psi = div (both over the cells of this rank) by one cycle, a linear map;
 * where no side gives the pressure, without its mean. */
void mesh_pressure_cycle(struct fv *s, const double *div, double *psi);

#endif
