/* flow_ops.h - what a stage of a time step is made of, as a table of functions that each kind of
 * cells provides: the integrators know nothing of grids. Functions that need ghosts of other ranks
 * set or require them as said; those with a global result are collective.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FLOW_OPS_H
#define FV_FLOW_OPS_H

#include "../fv.h"

struct side_face; /* boundary/bc.h */

/* The operators of one kind of cells. Fields are indexed like s->u. */
struct flow_ops {
    /* Removes the odd-even (checkerboard) mode from p and sets its ghosts; false: these cells need
     * it not, and p is as it was. */
    bool (*smooth_pressure)(struct fv *s);
    /* g = grad p; p comes with the ghosts that cells give, those at sides are set here. */
    void (*pressure_gradient)(struct fv *s, double *p, double *const g[3]);
    /* Keeps what the next projection, tau grad psi, will take off the velocity along the sides. */
    void (*set_slip)(const struct fv *s, double tau, const double *psi);
    /* N = div(U u), the convective term; as the next one it needs ghosts and imposed cells. */
    void (*convection)(struct fv *s, double *const N[3]);
    void (*viscous)(struct fv *s, int q, double *out);
    /* s->rhs: averages over volumes become those over indices; NULL: they are. */
    void (*to_index)(struct fv *s);
    /* Solves (1 - c L) delta = rhs, L = nu Lap, with what sides and partners impose at time t, s;
     * it may start from `scale' times the delta of the stage before (0: there is none). false: not
     * converged. */
    bool (*solve_viscous)(struct fv *s, double c, double t, double scale);
    /* U = I(u).n on all faces that this rank's stencils see; u with its ghosts. */
    void (*face_velocities)(struct fv *s, double *const u[3], double *const U[3]);
    /* The divergence of U as poisson_solve wants it, in scratch, for a stage of length tau. */
    double *(*divergence)(struct fv *s, double tau);
    /* Ghosts of a solution of the pressure's equation; NULL: who solves sets them. */
    void (*psi_ghosts)(struct fv *s, double *psi);
    /* U -= tau times the flux of psi; rhs = grad psi. */
    void (*correct_fluxes)(struct fv *s, double tau, double *psi);
    /* g = grad phi, of a change of psi. */
    void (*change_gradient)(struct fv *s, double *phi, double *const g[3]);
    /* With a surface: U of faces between dry cells, from u with its ghosts; stencils: of those
     * alone that stencils of wet cells reach. */
    void (*dry_fluxes)(struct fv *s, bool stencils);
    /* Sets s->max and what else bounds a step. push: m/s^2, from pressures on opposite sides;
     * motion: 1/s, cells per second that moving blocks pass. */
    void (*measure)(struct fv *s, double push, double motion);
    /* For a face of a wall or body, beside which p has its ghosts: adds the force on it, N (2D:
     * N/m), on blocks also the moment along z about the block's centre, N m. */
    void (*face_force)(const struct fv *s, const struct side_face *f, double sum[4]);
    /* Power that comes in through one face of a side, over rho: energy, work of pressure and of
     * friction. */
    double (*face_power)(const struct fv *s, const struct side_face *f);
};

/* Of uniform cells and layers of unequal height; of blocks. */
extern const struct flow_ops even_ops, block_ops;

#endif
