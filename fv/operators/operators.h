/* operators.h - operators on a uniform grid and on layers of unequal height: the functions behind
 * even_ops (flow_ops.h), fourth order on cell averages.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OPERATORS_H
#define FV_OPERATORS_H

#include "../boundary/fv_boundary.h"

/* convection.c: N_a = (sum over faces of F)/h, F = U q with transverse corrections; needs u with
 * ghosts, and U. */
void convection(struct fv *s, double *const N[3]);
/* q on the lower faces of a row of n even cells, `along' the stride to the cell below; bias_row
 * adds the upwind bias, C is fv.upwind. */
void convection_face_row(const double *q, int64_t along, int64_t n, double *out);
void convection_bias_row(const double *q, const double *U, int64_t along, int64_t n, double C,
                         double *out);
/* q on the lower faces along axis a of all cells and one layer more. */
void convection_face_values(const struct fv *s, const double *q, int a, double *out);
/* U = I(u).n on all faces that this rank's stencils see. */
void convection_face_velocities(struct fv *s, double *const u[3], double *const U[3]);

/* Values on faces along a behind walls that move along themselves, under a surface behind all
 * without slip, as products along their tangents need them. */
void convection_beside_walls(const struct fv *s, int a, double *f);

/* viscous.c: out = L q = nu Lap q in the free cells. Ghosts of q must be there. */
void viscous_apply(const struct fv *s, const double *q, double *out);
/* The same in a row of n even cells; c: nu/(12 h^2) along each axis. */
void viscous_row(const double *q, const int64_t *stride, const double *c, int dim, int64_t n,
                 double *out);
/* Solves (1 - c L) delta = rhs for all components, by CG, Chebyshev's iteration or BiCGStab; delta
 * comes with the imposed values in imposed cells and ghosts of the sides. tol: relative to the
 * first residual, or where the last increment is the start (viscous_keeps_increment) to rhs. false:
 * not converged. Collective. */
bool viscous_solve(struct fv *s, double c, double *const delta[3], double *const rhs[3],
                   double tol);
/* Whether delta should be kept for the next solve to start from. */
bool viscous_keeps_increment(const struct fv *s);

/* gradient.c: cell gradient along axis a, (8 (q_1 - q_-1) - (q_2 - q_-2))/12 h. q is extrapolated
 * into imposed cells with zero gradient (psi) or by a cubic (p), which at an outflow holds the
 * given p, or none for a variation of p. */
void gradient(const struct fv *s, const double *q, int a, enum continuation c, double *out);

/* smooth.c: takes a share of an odd-even (checkerboard) mode off p, which the central gradient does
 * not see but the one-sided ones at the boundary do: p -= share C'C p/64 along each axis, C the
 * third difference within the fluid. d: scratch. Collective. */
#define SMOOTHED 0.1 /* share that each step takes off its first pressure */
void smooth_odd_even(struct fv *s, double share, double *p, double *d);

/* even_forces.c: see face_force and face_power in flow_ops.h. */
struct side_face;
void even_face_force(const struct fv *s, const struct side_face *f, double sum[4]);
double even_face_power(const struct fv *s, const struct side_face *f);

#endif
