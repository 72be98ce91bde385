/* fv.h - the whole state of the finite-volume solver.
 * Cell averages of velocity and of kinematic pressure on a Cartesian block, fourth order,
 * face fluxes projected exactly each stage. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FV_H
#define FV_FV_H

#include <stdbool.h>
#include <stdint.h>

#include "../common/exact.h"
#include "../common/fit.h"
#include "../common/run.h"
#include "block.h"

enum fv_surface { SURFACE_NO, SURFACE_YES, SURFACE_AUTO };
enum fv_integrator { INTEGRATOR_RK3, INTEGRATOR_BDF2, INTEGRATOR_NEWTON };
enum fv_flux { FLUX_CENTRAL, FLUX_UPWIND };
/* What bounds a step, see limits.h. */
enum limit {
    LIMIT_NONE,
    LIMIT_FLOW,
    LIMIT_FORCES,
    LIMIT_OUTFLOW,
    LIMIT_BDF2,
    LIMIT_VISCOUS,
    LIMIT_WAVES,
    LIMIT_OUTPUT
};

struct fv_params {
    int cells[3];
    double cfl; /* of the largest sum over the axes of |u_a| dt/h_a; 0: the integrator's own */
    int integrator;
    double tol_pressure; /* of the last projection of a step, relative to |div U*| */
    double tol_viscous;  /* of Helmholtz; 0: 1e-3, with forced cells 1e-5 */
    double tol_newton;   /* of a residual, as a velocity relative to the largest */
    int flux;            /* newton only */
    double c0;           /* m/s: sound speed; newton only, 0: incompressible */
    bool steady;         /* newton only: march to a steady state */
    double graded[3];    /* m, rows: see rows.h; rows 0: all even */
    double hole[2][3];   /* box whose cells take the exact solution; all 0: none */
    double upwind;       /* C of the bias in convection.c; 0: none, -1: 1 with walls, else none */
    double extrema[3];   /* m/s: known ones on the centre lines, see fv_lines.c; 0: none */
    int surface;         /* enum fv_surface */
    double force[3];  /* N, N, 1/s: known mean along x, amplitude along y, its frequency; 0: none */
    int forced_order; /* in time, of partners' data within a window: 1 linear, 2 quadratic */
};

struct bc;       /* walls and openings; bc.h; NULL: none */
struct forcing;  /* cells whose velocity is imposed; forcing.h; NULL: none */
struct surface;  /* free surface; levelset.h; NULL: none */
struct pressure; /* the operator in hypre; pressure.h */
struct newton;   /* the implicit integrator; newton.h; NULL: another one */
struct link;     /* place in a coupled job; fv_coupling.c; NULL alone */
struct watches;  /* figures that a sound run keeps small; watches.h */

struct fv {
    struct run *run;
    struct fv_params prm;
    struct block b;
    struct exact exact;
    double nu;
    double t;
    double fastest; /* m/s: largest |u_a| in the rows of the series */
    bool has_exact;
    double *u[3];     /* m/s: cell averages, with ghosts */
    double *p;        /* m^2/s^2: p/rho, of the last step's end (rk3: at t - dt/6) */
    double *p_before; /* of the step before */
    double
        *psi[3];  /* of each stage: start of the next step's solve; rk3 and bdf2 use [0..2], [0] */
    double *U[3]; /* m/s: projected flux through the lower face of each cell */
    double *N[3], *N_old[3]; /* convection now and before (rk3: of a stage; bdf2: of a step) */
    double *u_old[3];        /* bdf2, newton; else NULL */
    double *rhs[3], *delta[3], *work[3], *step_p[3]; /* scratch: right side, increment, CG; Gc p */
    double *step_work;
    double *krylov[2][3];   /* scratch of the viscous solve with walls, else NULL */
    double still[3], level; /* m/s^2, m: gravity across closed sides, height where it makes no p */
    double drive[3];        /* m/s^2: gravity along periodic axes; across, the pressure takes it */
    double *face, *flux;    /* scratch */
    struct bc *bc;
    struct forcing *forcing;
    struct surface *surface;
    struct pressure *pressure;
    struct newton *newton;
    struct fit swing; /* of a standing wave: what swings, sampled */
    struct link *link;
    bool predicts; /* its steps will be taken back: nothing in them is to be judged or counted */
    double dt, dt_old;    /* s: last step, 0 before the first; the one before it */
    double partner[2][3]; /* m: box that a partner counts as its own; lo >= hi: none */
    double scene_speed;   /* m/s: limits_reference */
    double reference;     /* m/s: limits_follow */
    double u_limit;       /* m/s: beyond it the run has blown up */
    double umax[3];       /* m/s: largest |u_a| */
    double rate;          /* 1/s: largest sum over the axes of |u_a|/h_a of a cell */
    enum limit limit;     /* of the last step */
    double max_cfl;
    struct watches *watches; /* watches.h */
    int64_t iterations;      /* of the pressure solver */
    int64_t viscous_iterations;
};

/* fv_params.c */
enum { FV_GROUPS = 2 };
extern const struct param_group fv_groups[FV_GROUPS];
const struct fv_params *fv_params_of(const struct run *r);
void fv_params_check(const struct run *r, struct faults *f);

/* fv_unused.c: faults of keys that this run does not use. */
void fv_unused_check(const struct run *r, struct faults *f);
/* Whether errors against the exact solution are measured. */
bool fv_measures_errors(const struct run *r);
/* Whether output.fields has this word. */
bool fv_field_wanted(const struct run *r, const char *name);
/* fv_scene.c: faults of a scene on a grid of cells that contradicts itself. */
void fv_scene_check(const struct run *r, struct faults *f);

/* fv_state.c */
struct fv *fv_create(struct run *r, struct h5 *f);
void fv_free(struct fv **s);
/* After u and U have been set: ghosts, limits, the pressure that goes with them. */
void fv_start(struct fv *s);

/* convection.c: N_a = (sum over faces of F)/h, F = U q + transverse terms; needs u with ghosts and
 * U. */
void convection(struct fv *s, double *const N[3]);
/* U = I(u).n on all faces that this rank's stencils see. */
void convection_face_velocities(struct fv *s, double *const u[3], double *const U[3]);

/* Values on faces along a, behind walls that slide: as products along their tangents want them. */
void convection_beside_walls(const struct fv *s, int a, double *f);

/* viscous.c: out = L q = nu Lap q in the free cells. Ghosts of q must be there. */
void viscous_apply(const struct fv *s, const double *q, double *out);
/* Solves (1 - c L) delta = rhs for all components by CG; delta holds the imposed values in forced
 * cells and ghosts of the boundary; `tol' relative to the first residual. false: not converged. */
bool viscous_solve(struct fv *s, double c, double *const delta[3], double *const rhs[3],
                   double tol);

/* gradient.c: cell gradient along axis a, (8 (q_1 - q_-1) - (q_2 - q_-2))/12 h; q goes on into
 * forced cells evenly (psi) or by a cubic (p), which at an outflow
 * holds the given p, or for a variation of p none. */
enum continuation { CONTINUE_EVEN, CONTINUE_CUBIC, CONTINUE_VARIATION };
void gradient(const struct fv *s, const double *q, int a, enum continuation c, double *out);

/* projection.c: u, U and p by dt; false: a solver did not converge. */
bool projection_step(struct fv *s, double dt);
void pressure_start(struct fv *s);
/* Pressure at s->t, in Pa. */
double fv_pressure(const struct fv *s, int64_t c);
/* What gravity adds to it at x: the equations hold only the rest, so that water at rest stays so.
 */
double fv_still_pressure(const struct fv *s, const double *x);
/* Adds it to a field, in the local cells. */
void fv_add_still_pressure(const struct fv *s, double *p);
/* The part of it that the exact solution's pressure holds, too: all of it in a wave, else 0. */
double fv_still_in_exact(const struct fv *s, const double *x);

/* still.c: along a periodic axis gravity drives the flow; across closed sides the pressure takes it
 * up, 0 at the height `level'. */
void still_split(const struct scene *scene, double drive[3], double still[3], double *level);
/* Axis along which gravity is strongest; without gravity the last. */
int still_upright(const struct scene *scene);
/* That pressure at x, Pa. */
double still_pressure(const struct scene *scene, const double still[3], double level,
                      const double *x);

/* fv_step.c: one step towards t_stop, see program.step; d is filled when the state cannot be
 * trusted. */
double integrate(struct fv *s, double t_stop, struct diagnosis *d);
/* Largest |u_a| of what flows, or will soon. */
double fv_speed(const struct fv *s, int a);
void measure(struct fv *s);

/* fv_io.c, fv_errors.c */
/* Errors of velocity, pressure, vorticity into the summary. */
void fv_summarise_norms(const struct run *r, const struct norm n[3]);
/* sqrt(e2/r2); NAN where there is nothing to be relative to. */
double fv_relative(const struct norm *n);
/* The same of velocity for series.csv, relative to initial.U where the solution is at rest. */
double fv_velocity_error(const struct run *r, const struct norm *n);
/* |curl u|^2 of a cell in local row j, 1/s^2. */
double fv_curl_squared(const struct fv *s, int64_t c, int j);
void fv_vorticity(const struct fv *s,
                  double *w); /* dv/dx - du/dy, all local cells (with ghosts' layout) */
void fv_snapshot(void *s, struct h5 *f, struct xdmf *x, const char *file);
void fv_checkpoint(void *s, struct h5 *f);
bool fv_restore(struct fv *s, struct h5 *f);
/* The fields that a step starts from, and their names: their number. */
enum { FV_RESTART_FIELDS = 24 };
int fv_restart_fields(const struct fv *s, double **f, const char **names);
void fv_finish(void *s);
void fv_row(void *s, double *values);
/* Sums over what no partner counts, for the coupler; see program.tell. */
void fv_tell(void *s, struct summary *report);

/* fv_draw.c: see program.draw. */
struct picture;
void fv_draw(const struct run *r, struct picture *p);

/* fv_probes.c: the case's gauges; number of columns and their names (static), values on all ranks.
 */
int fv_probe_columns(const struct run *r, const char **columns);
void fv_probe(struct fv *s, double *values);

/* fv_lines.c: extrema on the centre lines into the summary. */
void fv_summarise_extrema(const struct fv *s);

/* fv_keep.c: a copy of the state, to take steps back. */
struct kept;
struct kept *kept_create(const struct fv *s);
void kept_free(struct kept **k);
void kept_take(struct kept *k, struct fv *s);
void kept_put_back(struct kept *k, struct fv *s);

/* fv_coupling.c: the only file here that knows cpl.h. */
void coupling_create(struct fv *s);
void coupling_free(struct fv *s);
/* Pa: to be added to the pressure for the partner's level; 0 alone. */
double coupling_datum(const struct fv *s);
/* Fills d where the partner has left out too many cells; share of them; worst one. */
void coupling_judge(struct fv *s, struct diagnosis *d);
double coupling_unmapped(const struct fv *s);
void coupling_summary(const struct fv *s, struct summary *to);
void coupling_first(void *s);
void coupling_window_begin(void *s, double t0, double t1);
void coupling_window_end(void *s, double t1);
void coupling_save(const struct fv *s, struct h5 *f);
bool coupling_load(struct fv *s, struct h5 *f);

#endif
