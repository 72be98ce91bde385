/* blocked_cells.h - what the operators on uniform cells do beside boxes that are cut out
 * (boundary/blocked.h): corrections of the few cells and faces whose stencils end there. Local to
 * the rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_BLOCKED_CELLS_H
#define FV_BLOCKED_CELLS_H

#include "../boundary/fv_boundary.h"

/* Values of component q on the faces along a; C: strength of the upwind bias by the fluxes U, 0:
 * none. */
void blocked_faces(const struct fv *s, int q, int a, const double *u, const double *U, double C,
                   double *face);
/* Convective fluxes F of component q along a: products beside boxes, zero through their faces. */
void blocked_fluxes(const struct fv *s, int q, int a, const double *U, const double *face,
                    double *F);
/* U = I(u).n on faces near boxes; only_dry: only between dry cells, those of the air beyond a
 * surface. */
void blocked_face_velocities(const struct fv *s, double *const u[3], double *const U[3],
                             bool only_dry);
/* blocked_set_slip keeps tau grad psi along no-slip faces, which the projection will take off the
 * velocity there; blocked_add_slip adds nu times the Laplacian of what that makes of component q in
 * an increment to out. */
void blocked_set_slip(const struct fv *s, double tau, const double *psi);
void blocked_add_slip(const struct fv *s, int q, double *out);
/* out = nu Lap of component q, in the cells near boxes. */
void blocked_viscous(const struct fv *s, int q, const double *u, double *out);
/* Derivative of component q along a in the own cell c, 0 in boxes. */
double blocked_derivative(const struct fv *s, int q, int a, int64_t c);
/* Sets q to zero in boxes. */
void blocked_zero(const struct fv *s, double *q);

#endif
