/* limits.h - what bounds a time step: crossing cells, forces that will speed the flow up, an
 * outflow, viscosity and waves of a free surface; and the velocity that a scene will have.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../fv.h"

/* A bound of the step, and what makes it. */
struct step_limit {
    double dt; /* s */
    enum limit by;
};

/* In a sentence: "flow", "outflow", "viscosity", "waves". */
const char *limit_name(enum limit by);
/* fv.cfl, or where it is 0 the integrator's own. */
double limits_cfl(const struct fv_params *p);
/* Faults of fv.cfl, and of bdf2 without viscosity. */
void limits_check(const struct run *r, const struct fv_params *p, struct faults *f);
/* Largest |u_a| of what flows, or will soon. */
double fv_speed(const struct fv *s, int a);
/* The largest step that the flow as it is allows, and what bounds it; the same on all ranks. */
struct step_limit limits_of(const struct fv *s);
/* Next time after now at which a block's motion starts or ends, s; INFINITY: none. */
double limits_next_motion(const struct fv *s);
/* The same before the start, for --check: cells of size h[3]. */
struct step_limit limits_estimate(const struct run *r, const struct fv_params *p, const double *h);

/* Warns where bdf2 is no choice, and where newton passes over a transient that the run ends in:
 * cells of size h at most, m. */
void limits_warn(const struct run *r, const struct fv_params *p, double h);

/* m^2/s^2: of p/rho between outflows. */
double limits_pressure_difference(const struct scene *s);

/* m/s: largest velocity of the scene that is known before the run: of the initial field, walls,
 * openings and shapes, of what falls, of what pressures and gravity along periodic axes drive; at
 * least a thousandth of the domain in the run's time, so that it is never 0. */
double limits_reference(const struct run *r);
/* 1/s: at which viscosity levels the vortices that a scene without a surface starts with: those of
 * the field, or of what shapes make flow, as thin as they are. 0: there are none. */
double limits_decay(const struct scene *s);
/* fv.upwind's default: 1 with walls, and where viscosity does not hold waves of two cells down: U
 * h/nu above 200, h the size of `cells' cells over the domain. */
double limits_upwind(const struct run *r, bool walls, double cells);
/* The running flow's own: follows the largest velocity by at most 2 % a step, so that a flow may
 * grow, but not blow up; returns the limit, 10 times it. */
double limits_follow(double *reference, double most);
/* Why a run may have blown up whose last step crossed `before' cells at its start, `after' at its
 * end, and what to do. */
void limits_explain(const struct fv_params *p, enum limit by, double before, double after,
                    bool surface, char *text, size_t size);
