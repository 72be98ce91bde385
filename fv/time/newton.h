/* newton.h - fully implicit steps: three-point backward differences, all unknowns q = (p, u, v[,
 * w]) at once by Newton-Krylov (KINSOL), for large steps and steady states.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_NEWTON_H
#define FV_NEWTON_H

#include <nvector/nvector_parallel.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>

#include "../fv.h"
#include "../operators/fv_operators.h"

/* A state, or a variation of one, with ghosts. */
struct flow {
    double *p, *u[3]; /* m^2/s^2, m/s */
    double *U[3];     /* fluxes through lower faces, in the unit of s->U */
    double *G[3];     /* gradient of p, m/s^2 */
};

/* What a residual depends on besides q; constant during a step. */
struct newton_step {
    double t;          /* s: of the new level */
    double c0, c1, c2; /* 1/s: of the backward difference */
    double d;          /* s: of the pressure's part in a face's flux */
    double scale;      /* s: makes a momentum residual a velocity */
    double U;          /* m/s: scale of velocity */
    double rate;       /* 1/s: of convection and diffusion through a cell */
};

/* What the equations are made of on each kind of cells; sides and imposed cells of a variation are
 * 0.
 */
struct newton_cells {
    /* Rates and local scales of the step's start; called by newton_set_step. */
    void (*set_rates)(struct fv *s);
    /* s->faces[0] = D U, s->rhs = D F + G p - nu L u - g, of the state, with its ghosts. */
    void (*evaluate)(struct fv *s);
    /* The same along the variation w->v; NULL: by difference quotients. */
    void (*evaluate_variation)(struct fv *s);
    /* Rows A of the preconditioner from the fluxes of the state, but for what a surface changes. */
    void (*fill_rows)(struct fv *s);
    /* out = the diagonal of -Lap in each cell, 1/m^2, sides and the surface aside; dual time. */
    void (*laplacian)(const struct fv *s, double *out);
    /* div -= D I(x); x with its ghosts. */
    void (*subtract_divergence)(struct fv *s, double *const x[3], double *div);
};
/* Of uniform cells and layers of unequal height; of blocks. */
extern const struct newton_cells newton_even, newton_blocks;

/* What the integrator keeps from step to step, with KINSOL's objects; all is owned. */
struct newton {
    const struct newton_cells *cells_of;
    SUNContext ctx;
    void *kin;              /* KINSOL's memory */
    SUNLinearSolver krylov; /* NULL in dual time */
    N_Vector q, q1,
        q2; /* the unknown, and one and two levels before: p, u, v[, w] of local cells */
    N_Vector uscale, fscale, residual;
    int64_t cells; /* local */
    int longest;   /* of all rows of cells along an index */
    struct newton_step of;
    struct flow v;        /* variation, for J v */
    double *G[3];         /* gradient of the state's p */
    double *face, *dface; /* scratch */
    double *d;            /* s: of.d of each cell; blocks */
    double *A[7];         /* the momentum operator of the preconditioner: 1/diagonal, -x, +x, .. */
    double *x[3], *r[3], *phi, *div; /* its unknowns and right sides */
    N_Vector pseudo;     /* m^2/s, s: what newton_dual.c multiplies residuals by; else NULL */
    double dtau, norm;   /* s, -: pseudo step; scaled residual (rms) after the last one */
    double longest_step; /* s: bound of dtau that unsolved linear systems leave */
    double pace;         /* -: lately best fall of the logarithm of norm a Krylov vector */
    double left;         /* -: residual that the last pseudo step left in its own equation */
    double best;         /* -: least norm so far, reached at the pseudo step best_at */
    int64_t best_at, pseudo_steps;              /* in dual time of the step under way, as best */
    bool steady;                                /* reached */
    int64_t newtons, krylovs, cycles, halvings; /* summed over the run */
};

/* Makes KINSOL's objects and the scratch for the cells that s has; owned by the caller.
 * Collective. */
struct newton *newton_create(struct fv *s);
/* One step of dt s from s->t; false: not converged, and the state is not one. */
bool newton_try(struct fv *s, double dt);
/* Counts a pseudo step that leaves w->norm, and says whether the least norm is `most' of them old:
 * it goes up while eddies form, and down at last. */
bool newton_stalls(struct newton *w, int64_t most);
/* Where the last solve failed, and why it may have. */
void newton_describe(struct fv *s, const char *after, struct diagnosis *d);
/* One step of at most *dt s from s->t, halved as often as Newton fails (then d tells why). */
bool newton_step(struct fv *s, double *dt, struct diagnosis *d);
/* One step of pseudo-time towards the steady state, the first of dtau s, then as the residual
 * falls. It counts as a 500th of the run's time, and what is left of it passes once the state is
 * steady. Returns that time. */
double newton_pseudo_step(struct fv *s, double dtau, double t_stop, struct diagnosis *d);

/* KINSOL's handler of errors, which says nothing: newton_step tells what failed, once. */
void newton_no_message(int code, const char *module, const char *function, char *text, void *user);

/* newton_residual.c: fills the vector q of local cells from fields with ghosts. */
void newton_pack(const struct fv *s, const double *p, double *const u[3], N_Vector q);
/* Fills the local cells of the fields from q; ghosts stay as they are. */
void newton_unpack(const struct fv *s, N_Vector q, double *p, double *const u[3]);
/* Coefficients of a step of dt after one of dt_old (0: none, then one-sided). */
void newton_set_step(struct fv *s, double dt, double dt_old);
/* r = R(q), the residual of the equations. A KINSysFn of KINSOL: user is the struct fv; returns 0.
 * Collective. */
int newton_residual(N_Vector q, N_Vector r, void *user);
/* q = 0 in cells that are not solved for. */
void newton_clear(const struct fv *s, double *q);
/* out = R'(q) v at the q of the last residual. A KINLsJacTimesVecFn of KINSOL. Collective. */
int newton_jacobian_times(N_Vector v, N_Vector out, N_Vector q, booleantype *is_new, void *user);

/* newton_residual.c: coefficient of the dissipation in newton's convection, -: 1/12 with fv.flux =
 * "upwind", else 1/96. */
double newton_dissipation(const struct fv *s);

/* newton_dual.c: makes w->kin and w->pseudo of dual time; newton_create's closing function frees
 * them. Collective. */
void newton_dual_create(struct fv *s, struct newton *w);
/* Solves R(q) = 0 for w->q, from what it holds, to fv.tol_newton; the largest scaled residual is
 * left in w->norm. Returns KIN_SUCCESS or KIN_MAXITER_REACHED, on all ranks alike. */
int newton_dual_solve(struct fv *s);
/* Writes to text[size] what may help where the last solve failed. */
void newton_dual_explain(const struct fv *s, char *text, size_t size);

/* newton_vector.c: gives q, and what is cloned from it, faster sums. */
void newton_vector_sums(N_Vector q);

/* newton_precond.c: makes the preconditioner at the state q, an incomplete block factorisation:
 * sweeps over momentum, a V-cycle for the pressure. KINSOL's functions of such a thing. */
int newton_precond_setup(N_Vector q, N_Vector uscale, N_Vector f, N_Vector fscale, void *user);
/* Applies it to v in place. */
int newton_precond_solve(N_Vector q, N_Vector uscale, N_Vector f, N_Vector fscale, N_Vector v,
                         void *user);

#endif
