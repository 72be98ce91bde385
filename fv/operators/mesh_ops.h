/* mesh_ops.h - operators on curvilinear cells: the functions behind block_ops (flow_ops.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_OPS_H
#define FV_MESH_OPS_H

#include "../fv.h"
#include "../grid/fv_grid.h"

/* mesh_ops.c: all of fourth order, from fields with their ghosts. S_ab is the face vector of faces
 * across index a, G_ab the metric tensor on them, V the volume of a cell. */

/* U_a = sum over k of the face averages <u_k S_ak>, m^dim/s, through the faces across each index,
 * and one layer of tangents more, which products of face averages need. */
void mesh_face_velocities(struct fv *s, double *const u[3], double *const U[3]);
/* N_k = (1/V) sum over faces of <U u_k>, m/s^2, with the fluxes relative to a block that moves, the
 * bias fv.upwind and the dissipation of fv.dissipation. Scratch: s->faces[0], s->flux, s->rhs. */
void mesh_convection(struct fv *s, double *const N[3]);
/* g_k = (1/V) sum over faces of <q S_k>, by Gauss's theorem: the mean of dq/dx_k over the cell. */
void mesh_gradient(struct fv *s, const double *q, double *const g[3]);
/* out = (nu/V) sum over faces of <G_ab dq/dxi_b>, the mean of nu Lap q; 0 in cells that are not
 * computed. */
void mesh_viscous(struct fv *s, const double *q, double *out);
/* Solves (1 - c L) delta = rhs with what the sides change from one time to the next; delta: start
 * and result. tol: relative to the residual of delta = 0. false: not converged. Collective. */
bool mesh_viscous_solve(struct fv *s, double c, double tol);
/* Whether the operator of that is symmetric: blocks of uniform cells that do not move, with joined
 * or periodic sides alone. Collective. */
bool mesh_viscous_symmetric(const struct fv *s);
/* A bound of the eigenvalues of -L, 1/s. */
double mesh_viscous_largest(const struct fv *s);
/* div = sum of the fluxes U out of each cell, m^dim/s. */
void mesh_divergence(const struct fv *s, double *const U[3], double *div);
/* U -= tau times the flux of psi, as the pressure matrix has it. */
void mesh_subtract_psi(struct fv *s, double tau, const double *psi, double *const U[3]);
/* Turns averages over volume into averages over indices; q with ghosts, work: scratch. */
void mesh_to_index(const struct fv *s, double *q, double *work);
/* The inverse, to fourth order, also beside sides; sets the ghosts of q. */
void mesh_to_volume(struct fv *s, double *q, double *work);
/* Removes the odd-even (checkerboard) mode from p along each index, as smooth_odd_even does on
 * uniform cells; p with its ghosts, scratch: s->faces[0], s->flux. */
void mesh_smooth_pressure(struct fv *s);

/* mesh_forces.c: see face_force and face_power in flow_ops.h. */
struct side_face;
void mesh_face_force(const struct fv *s, const struct side_face *d, double sum[4]);
double mesh_face_power(const struct fv *s, const struct side_face *d);

#endif
