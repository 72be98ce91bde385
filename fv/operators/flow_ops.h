/* flow_ops.h - what a stage of a time step is made of, on each kind of cells: the integrators know
 * nothing of grids. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FLOW_OPS_H
#define FV_FLOW_OPS_H

#include "../fv.h"

struct side_face; /* boundary/bc.h */

struct flow_ops {
    /* p, with its ghosts, without its odd-even mode; false: it needs none, or is as it was. */
    bool (*smooth_pressure)(struct fv *s);
    /* g = grad p; p with the ghosts that cells have, sets the others. */
    void (*pressure_gradient)(struct fv *s, double *p, double *const g[3]);
    /* What the next projection will take off the velocity of the sides. */
    void (*set_slip)(const struct fv *s, double tau, const double *psi);
    /* Ghosts and imposed cells must be there for the next two. */
    void (*convection)(struct fv *s, double *const N[3]);
    void (*viscous)(struct fv *s, int q, double *out);
    /* s->rhs: averages over volumes become those over indices; NULL: they are. */
    void (*to_index)(struct fv *s);
    /* delta with (1 - c L) delta = rhs, what is given at time t; it may start from `scale' times
     * the delta of the stage before (0: there is none). false: not converged. */
    bool (*solve_viscous)(struct fv *s, double c, double t, double scale);
    /* U = I(u).n on all faces that this rank's stencils see; u with its ghosts. */
    void (*face_velocities)(struct fv *s, double *const u[3], double *const U[3]);
    /* The divergence of U as poisson_solve wants it, in scratch, for a stage of length tau. */
    double *(*divergence)(struct fv *s, double tau);
    /* Ghosts of a solution of the pressure's equation; NULL: who solves sets them. */
    void (*psi_ghosts)(struct fv *s, double *psi);
    /* U less tau times the flux of psi; rhs = grad psi. */
    void (*correct_fluxes)(struct fv *s, double tau, double *psi);
    /* g = grad phi, of a change of psi. */
    void (*change_gradient)(struct fv *s, double *phi, double *const g[3]);
    /* With a surface: U of faces between dry cells, from u with its ghosts. */
    void (*dry_fluxes)(struct fv *s);
    /* s->max.u, rate and what else bounds a step. push: m/s^2, of pressures on opposite sides;
     * motion: 1/s, cells that moving blocks pass. */
    void (*measure)(struct fv *s, double push, double motion);
    /* Of a face of a wall or body, beside which p has its ghosts: adds the force on it, N (per
     * metre in 2D), on blocks also the moment along z about the block's centre, Nm. */
    void (*face_force)(const struct fv *s, const struct side_face *f, double sum[4]);
    /* What comes in through one of a side: energy, work of pressure and of friction, over rho. */
    double (*face_power)(const struct fv *s, const struct side_face *f);
};

extern const struct flow_ops even_ops, block_ops;

#endif
