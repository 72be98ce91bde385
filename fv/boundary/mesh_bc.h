/* mesh_bc.h - physical sides of blocks, and the exact solution there.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_BC_H
#define FV_MESH_BC_H

#include "../grid/mesh.h"
#include "bc.h"

/* mesh_sides.c */
void mesh_bc_create(struct fv *s);
void mesh_bc_free(struct mesh_bc **b);
void mesh_bc_time(struct fv *s, double t);
void mesh_bc_set_slip(const struct fv *s, double tau, const double *psi);
bool mesh_bc_pressure_given(const struct fv *s);
bool mesh_bc_has_walls(const struct mesh *m);

/* mesh_ghosts.c */
void mesh_bc_velocity(const struct fv *s, enum bc_value what, double *const u[3]);
/* With a surface: psi's ghosts behind walls that move have the slope of the walls' acceleration,
 * and fluxes of psi through them along axis a; in a stage of length tau. */
void mesh_bc_slope_ghosts(const struct fv *s, double tau, double *psi);
void mesh_bc_slope_fluxes(const struct fv *s, double tau, int a, double *F);
/* Mirrored; `odd': at an outflow with its sign turned. */
void mesh_bc_even(const struct fv *s, bool odd, double *q);
/* A level set, mirrored; behind walls that are neither level nor upright it goes on with the slope
 * that it has beside them. keep: with that of the last call. */
void mesh_bc_level(const struct fv *s, bool keep, double *phi);
/* Continued by the parabola through three cells, whatever the side. */
void mesh_bc_extend(const struct fv *s, double *q);
void mesh_bc_pressure(const struct fv *s, double *p);

/* mesh_side_fluxes.c: what flows through sides. */
void mesh_bc_fluxes(const struct fv *s, double *const U[3]);
/* See convection_beside_walls; of one part. */
void mesh_bc_beside_walls(const struct fv *s, const struct part *p, int a, double *f);
/* Whether a wall of this rank moves along itself. */
bool mesh_bc_slides(const struct fv *s);
/* Largest sum over the indices of |w.S|/V at the sides, over this rank; largest speed. */
double mesh_bc_rate(const struct fv *s, double *speed);
/* Through all sides of the case, outwards, over all ranks: what the overlap makes, m^dim/s. */
double mesh_bc_net_flux(const struct fv *s);
/* The sum of the vectors of their faces, m^(dim-1). */
void mesh_bc_vectors(const struct fv *s, double sum[3]);
/* See sides_visit. */
void mesh_bc_visit(const struct fv *s, void (*visit)(const struct side_face *f, void *with),
                   void *with);
/* Through this rank's faces whose velocity is given for good, outwards, m^dim/s. */
double mesh_bc_given_flux(const struct fv *s);

/* mesh_exact.c: the exact solution at a place. */
void mesh_exact_at(const struct fv *s, const double *x, double t, double *u, double *p, double *w);

#endif
