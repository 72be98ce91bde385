/* mesh_bc.h - physical sides of blocks, and the exact solution there: for blocks what bc.h is for
 * the uniform grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_BC_H
#define FV_MESH_BC_H

#include "../grid/fv_grid.h"
#include "bc.h"

/* mesh_sides.c: makes s->sides, the physical sides of this rank's parts of blocks. */
void mesh_bc_create(struct fv *s);
/* Sets the velocities of the sides to those of time t, s; those before are kept for BC_CHANGE. */
void mesh_bc_time(struct fv *s, double t);
/* At the start: what walls that move gain at once is what they have more than the water beside. */
void mesh_bc_meet_water(struct fv *s);
/* Sets the slip error tau grad psi along the sides, for BC_AHEAD; tau, s: length of the stage.
 * Collective. */
void mesh_bc_set_slip(const struct fv *s, double tau, const double *psi);
/* Whether a side of any block gives the pressure. */
bool mesh_bc_pressure_given(const struct fv *s);
/* Whether a side of any block is a wall, with or without slip. */
bool mesh_bc_has_walls(const struct mesh *m);

/* mesh_ghosts.c: sets the ghosts of a velocity behind the sides. */
void mesh_bc_velocity(const struct fv *s, enum bc_value what, double *const u[3]);
/* With a surface: psi's ghosts behind walls that move have the slope of the walls' acceleration,
 * and so have the fluxes of psi through them along axis a; tau: length of the stage, s. */
void mesh_bc_slope_ghosts(const struct fv *s, double tau, double *psi);
void mesh_bc_slope_fluxes(const struct fv *s, double tau, int a, double *F);
/* Zero-gradient ghosts of a scalar; odd: antisymmetric at outflows. */
void mesh_bc_even(const struct fv *s, bool odd, double *q);
/* Ghosts of a level set: zero gradient; behind walls that are neither along gravity nor across it,
 * continued with the slope that it has beside them. keep: with the slope of the last call. */
void mesh_bc_level(const struct fv *s, bool keep, double *phi);
/* Ghosts by the parabola through three cells, at any side. */
void mesh_bc_extend(const struct fv *s, double *q);
/* Ghosts of the pressure: the given one on outflows, elsewhere as the last. */
void mesh_bc_pressure(const struct fv *s, double *p);
/* The same of a pressure that is all of psi: as psi's in the last projection. */
void mesh_bc_whole_pressure(const struct fv *s, double *p);

/* mesh_side_fluxes.c: flow through sides. Sets U of faces whose velocity is given. */
void mesh_bc_fluxes(const struct fv *s, double *const U[3]);
/* As convection_beside_walls (operators/operators.h), for one part. */
void mesh_bc_beside_walls(const struct fv *s, const struct part *p, int a, double *f);
/* Whether a wall of this rank moves along itself. */
bool mesh_bc_slides(const struct fv *s);
/* Largest sum over the indices of |w.S|/V at the sides, 1/s, of this rank; *speed: the largest
 * speed, m/s. */
double mesh_bc_rate(const struct fv *s, double *speed);
/* Net flow outwards through all sides of the case, m^dim/s, over all ranks: the error that the
 * overlap makes. Collective. */
double mesh_bc_net_flux(const struct fv *s);
/* Sum of the area vectors of their faces, m^(dim-1). */
void mesh_bc_vectors(const struct fv *s, double sum[3]);
/* Calls visit for each face of these sides, as sides_visit does. */
void mesh_bc_visit(const struct fv *s, void (*visit)(const struct side_face *f, void *with),
                   void *with);
/* Flow outwards through this rank's faces whose velocity is given and does not change, m^dim/s. */
double mesh_bc_given_flux(const struct fv *s);

/* mesh_exact.c: the exact solution at a point: u, m/s, p, Pa, vorticity w, 1/s (NULL: not
 * wanted). */
void mesh_exact_at(const struct fv *s, const double *x, double t, double *u, double *p, double *w);

#endif
