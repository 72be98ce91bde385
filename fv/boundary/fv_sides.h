/* fv_sides.h - physical sides of the domain and of blocks, whatever the cells: what stands above
 * this folder asks here and need not know whether bc.h or mesh_bc.h has them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_SIDES_H
#define FV_SIDES_H

#include "bc.h"

/* One bit (1 << kind) for each kind of the sides; behind those of uniform cells that are neither
 * periodic nor have an entry of `walls' stands the exact velocity. */
unsigned sides_kinds(const struct fv *s);
/* Whether fluid passes one of them (side_is_opening). */
bool sides_open(const struct fv *s);
/* Whether one of them is an inflow whose velocity the case gives; under a surface these are listed
 * with the openings (carried.h). */
bool sides_give_inflow(const struct fv *s);
/* Whether one of them gives the pressure, so that the pressure equation is regular. */
bool sides_give_pressure(const struct fv *s);
/* Whether a wall of this rank moves along itself. */
bool sides_slide(const struct fv *s);
/* Sets all ghosts of a velocity: from cells and by the sides. Collective. */
void sides_velocity(const struct fv *s, enum bc_value what, double *const u[3]);
/* Sets U of the faces whose velocity is given. */
void sides_fluxes(const struct fv *s, enum bc_value what, double *const U[3]);
/* Sets the sides' values to those of time t, s, where they change with it; those before are
 * kept. */
void sides_time(struct fv *s, double t);
/* Calls visit for each face of this rank's physical sides, openings and walls alike. */
void sides_visit(const struct fv *s, void (*visit)(const struct side_face *f, void *with),
                 void *with);
/* The same for the faces of free cells on boxes that are cut out. */
void sides_visit_boxes(const struct fv *s, void (*visit)(const struct side_face *f, void *with),
                       void *with);
/* Adds what the bed friction of slip walls takes of the cells beside them to N, the rate at which
 * the velocity falls, m/s^2. */
void sides_brake(const struct fv *s, double *const N[3]);
/* Adds the force of that on the wet share of a face to sum, N, in 2D N/m. */
void side_friction_force(const struct fv *s, const struct side_face *f, double share,
                         double sum[4]);
/* Flow through this rank's openings, m^dim/s: adds inflow minus outflow to sums[0] and inflow plus
 * outflow to sums[1], of each face the share of the cell inside that counts (in: offset one cell
 * inwards). */
void sides_passing(const struct fv *s, double (*share)(const struct fv *s, int64_t c, int64_t in),
                   double sums[2]);

#endif
