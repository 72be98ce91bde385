/* mesh_flow.h - the state of a flow on a mesh of blocks: README.md, "Blocks".
 * Unknowns are averages of Cartesian velocity and of p/rho over cells in index space; fluxes
 * through faces are projected. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_FLOW_H
#define FV_MESH_FLOW_H

#include "../common/exact.h"
#include "fv.h"
#include "mesh.h"

struct mesh_bc;       /* mesh_bc.c */
struct mesh_pressure; /* mesh_pressure.c */
struct overset;       /* of the gauges; NULL: none */

struct mesh_flow {
    struct run *run;
    struct fv_params prm;
    struct mesh *m;
    struct exact exact;
    bool has_exact;
    int ring; /* block whose walls make Couette flow in a ring (initial.field = couette); -1: none
               */
    double nu, t;
    double fastest;            /* m/s: umax in the rows of the series */
    bool uneven;               /* volumes differ: volume averages are not averages in index space */
    double *u[3];              /* m/s */
    double *p, *p_before;      /* m^2/s^2, as in struct fv */
    double *start[3], *psi[3]; /* of each stage: start of the next solve, psi */
    double *U[3];              /* m^dim/s: through the lower face of each cell */
    double *N[3], *N_old[3];   /* m/s^2: convection */
    double *rhs[3], *delta[3], *step_p[3], *work[3], *krylov[5][3]; /* scratch */
    double *face[3], *flux, *grad[3];
    double *free;  /* 1: computed, 0: not */
    double *scale; /* of the viscous rows */
    double drive[3], still[3], level;
    struct mesh_bc *bc;
    struct mesh_pressure *pressure;
    struct overset *search;
    double dt, dt_old, u_limit, reference, umax, max_cfl;
    double rate, rise; /* 1/s, 1/s^2: see mesh_measure */
    enum limit limit;  /* of the last step */
    struct watches *watches;
    double defect; /* largest |net flux that the overlap makes| over U L^(dim-1) */
    double defect_now;
    int64_t start_iterations; /* of the pressure, before the first step */
    int64_t iterations, viscous_iterations, retries;
    bool failed; /* the pressure solver */
    int nhistory;
    double (*history)[3]; /* t, force x, force y of each row of the series */
};

/* mesh_ops.c: all need ghosts. */
void mesh_face_velocities(struct mesh_flow *s, double *const u[3], double *const U[3]);
void mesh_convection(struct mesh_flow *s, double *const N[3]);
void mesh_gradient(struct mesh_flow *s, const double *q, double *const g[3]);
void mesh_viscous(struct mesh_flow *s, const double *q, double *out);
void mesh_divergence(const struct mesh_flow *s, double *const U[3], double *div); /* m^dim/s */
/* U -= tau times the flux of psi, as the pressure matrix has it. */
void mesh_subtract_psi(struct mesh_flow *s, double tau, const double *psi, double *const U[3]);
/* q -= what makes an average over volume one over indices; q with ghosts, work: scratch. */
void mesh_to_index(const struct mesh_flow *s, double *q, double *work);
void mesh_smooth_pressure(struct mesh_flow *s);
void mesh_vorticity(struct mesh_flow *s, double *w);

/* mesh_bc.c */
/* Of a velocity; of one that is still to be projected; of the increment to that; of a difference.
 */
enum mesh_value { MESH_GIVEN, MESH_AHEAD, MESH_CHANGE, MESH_ZERO };
void mesh_bc_create(struct mesh_flow *s);
void mesh_bc_free(struct mesh_bc **b);
void mesh_bc_time(struct mesh_flow *s, double t);
void mesh_bc_set_slip(const struct mesh_flow *s, double tau, const double *psi);
void mesh_bc_velocity(const struct mesh_flow *s, enum mesh_value what, double *const u[3]);
/* Mirrored; `odd': at an outflow with its sign turned. */
void mesh_bc_even(const struct mesh_flow *s, bool odd, double *q);
void mesh_bc_pressure(const struct mesh_flow *s, double *p);
void mesh_bc_fluxes(const struct mesh_flow *s, double *const U[3]);
/* See convection_beside_walls; of one part. */
void mesh_bc_beside_walls(const struct mesh_flow *s, const struct mesh_part *p, int a, double *f);
bool mesh_bc_pressure_given(const struct mesh_flow *s);
/* Largest sum over the indices of |w.S|/V at the sides, over this rank; largest speed. */
double mesh_bc_rate(const struct mesh_flow *s, double *speed);
/* Through all sides of the case, outwards, over all ranks: what the overlap makes, m^dim/s. */
double mesh_bc_net_flux(const struct mesh_flow *s);
bool mesh_bc_has_walls(const struct mesh *m);
/* Forces on the no-slip walls of each block, N (per metre in 2D), and the moment about its centre.
 */
void mesh_bc_force(struct mesh_flow *s, double (*force)[4]);
/* What comes in through this rank's sides: energy, work of pressure and of friction, over rho. */
double mesh_bc_power(struct mesh_flow *s);

/* mesh_pressure.c: A psi = -div/tau; div with what the overlap makes taken out evenly. */
void mesh_pressure_create(struct mesh_flow *s);
void mesh_pressure_free(struct mesh_pressure **p);
/* false: did not converge. start: kept for the next solve. */
bool mesh_pressure_solve(struct mesh_flow *s, double tau, const double *div, double tol,
                         double *start, double *psi);

/* mesh_step.c */
double mesh_integrate(struct mesh_flow *s, double t_stop, struct diagnosis *d);
void mesh_measure(struct mesh_flow *s);
/* Divergence-free fluxes for the velocities of the start. */
void mesh_project(struct mesh_flow *s, int stage, double tau, double tol);
double mesh_pressure_at(const struct mesh_flow *s, int64_t c); /* Pa, without what gravity makes */

/* mesh_state.c */
struct mesh_flow *mesh_flow_create(struct run *r, struct h5 *f);
void mesh_flow_free(struct mesh_flow **s);
void mesh_exact_average(const struct mesh_flow *s, const struct mesh_part *p, const int *i,
                        double t, double *u, double *pressure, double *w);
void mesh_exact_at(const struct mesh_flow *s, const double *x, double t, double *u, double *p,
                   double *w);

/* mesh_errors.c: this rank's share of the value at a place, of the finest block there; q NULL:
 * pressure. width 2: linear, 4: cubic from averages. */
double mesh_value_at(const struct mesh_flow *s, const struct overset *o, const double *x, int width,
                     const double *q);
/* fv_lines.c: extrema on the centre lines of the domain into the summary. */
void mesh_summarise_extrema(const struct mesh_flow *s);

/* mesh_io.c, mesh_errors.c: what fv.c calls */
void mesh_describe(const struct run *r);
int mesh_columns(const struct run *r, const char **columns);
void mesh_row_values(void *s, double *values);
void mesh_progress(void *s, char *line, int size);
void mesh_snapshot(void *s, struct h5 *f, struct xdmf *x, const char *file);
void mesh_checkpoint(void *s, struct h5 *f);
bool mesh_restore(struct mesh_flow *s, struct h5 *f);
void mesh_finish(void *s);

#endif
