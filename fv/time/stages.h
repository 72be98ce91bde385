/* stages.h - what a stage of a time step is made of, on each kind of cells: the integrators know
 * nothing of grids. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_STAGES_H
#define FV_STAGES_H

#include "../boundary/fv_sides.h"
#include "../fv.h"
#include "../operators/operators.h"
#include "steps.h"

struct stages {
    /* step_p = grad p of the step's start, p without its odd-even mode. */
    void (*pressure_gradient)(struct fv *s);
    /* What the next projection will take off the velocity of the sides. */
    void (*set_slip)(struct fv *s, double tau, const double *psi);
    /* Conditions on the sides dt after outflow_begin, at t. */
    void (*set_sides)(struct fv *s, double t, double dt);
    /* Ghosts and imposed cells must be there for the next two. */
    void (*convection)(struct fv *s, double *const N[3]);
    void (*viscous)(struct fv *s, int q, double *out);
    /* Right sides: averages over volumes become those over indices; NULL: they are. */
    void (*finish_rhs)(struct fv *s);
    /* delta with (1 - c L) delta = rhs, what is given at time t; it may start from `scale' times
     * the delta of the stage before (0: there is none). false: not converged. */
    bool (*solve_viscous)(struct fv *s, double c, double t, double scale);
    /* U of u ahead of its projection, at time t. */
    void (*predict_fluxes)(struct fv *s, double t);
    /* psi[stage], with ghosts, of the fluxes U; false: not converged. */
    bool (*solve_pressure)(struct fv *s, int stage, double tau, double tol);
    /* U less tau times the flux of psi; rhs = grad psi. */
    void (*correct_fluxes)(struct fv *s, double tau, double *psi);
    /* With a surface: U of faces between dry cells, from u with its ghosts. */
    void (*dry_fluxes)(struct fv *s);
    void (*measure)(struct fv *s);
};

extern const struct stages even_stages, block_stages;

/* fv_step.c: "cell (i, j, k)", of which block; its centre. */
void cell_place(const struct fv *s, int64_t c, char *text, size_t size, double x[3]);
/* projection.c: makes u and U solenoidal; psi[stage] is the start and the result. */
void projection(struct fv *s, double t, int stage, double tau, double tol);

#endif
