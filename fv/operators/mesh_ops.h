/* mesh_ops.h - operators on curvilinear cells. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_OPS_H
#define FV_MESH_OPS_H

#include "../fv.h"
#include "../grid/mesh.h"

/* mesh_ops.c: all need ghosts. */
void mesh_face_velocities(struct fv *s, double *const u[3], double *const U[3]);
void mesh_convection(struct fv *s, double *const N[3]);
void mesh_gradient(struct fv *s, const double *q, double *const g[3]);
void mesh_viscous(struct fv *s, const double *q, double *out);
/* Solves (1 - c L) delta = rhs with what the sides change from one time to the next; delta: start
 * and result. tol: of what delta = 0 leaves. false: not converged. */
bool mesh_viscous_solve(struct fv *s, double c, double tol);
/* Whether the operator of that is symmetric: joins alone and cells all alike. */
bool mesh_viscous_symmetric(const struct fv *s);
/* 1/s: a bound of the eigenvalues of -L. */
double mesh_viscous_largest(const struct fv *s);
void mesh_divergence(const struct fv *s, double *const U[3], double *div); /* m^dim/s */
/* U -= tau times the flux of psi, as the pressure matrix has it. */
void mesh_subtract_psi(struct fv *s, double tau, const double *psi, double *const U[3]);
/* q -= what makes an average over volume one over indices; q with ghosts, work: scratch. */
void mesh_to_index(const struct fv *s, double *q, double *work);
/* The other way, to fourth order, also beside sides; sets the ghosts of q. */
void mesh_to_volume(struct fv *s, double *q, double *work);
void mesh_smooth_pressure(struct fv *s);

/* mesh_forces.c: see face_force and face_power in flow_ops.h. */
struct side_face;
void mesh_face_force(const struct fv *s, const struct side_face *d, double sum[4]);
double mesh_face_power(const struct fv *s, const struct side_face *d);

#endif
