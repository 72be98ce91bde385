/* fv.h - the whole state of the finite-volume solver; what each folder does with it stands in its
 * headers. Cell averages of velocity and of kinematic pressure on a Cartesian block, fourth order,
 * face fluxes projected exactly each stage. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FV_H
#define FV_FV_H

#include "../common/run/run.h"
#include "../common/scene/scene.h"
#include "grid/fv_grid.h"

/* Most programs of particles that a job can couple with this one. */
enum { PARTNERS_MAX = PARAM_PROGRAMS_MAX };
/* fv.surface: whether a free surface is computed; AUTO as the scene has one. */
enum fv_surface { SURFACE_NO, SURFACE_YES, SURFACE_AUTO };
/* fv.volume, how the surface keeps its water: phi is shifted as a whole, or the share of water of
 * each cell is advected in conservative form (surface/fraction.h); AUTO: the latter where it can
 * be. */
enum fv_volume { VOLUME_AUTO, VOLUME_SHIFT, VOLUME_FRACTION };
/* fv.integrator: three projected Runge-Kutta stages, the two-step backward difference with a
 * projection, or the same difference solved for velocity and pressure at once (time/newton.h). */
enum fv_integrator { INTEGRATOR_RK3, INTEGRATOR_BDF2, INTEGRATOR_NEWTON };
/* fv.flux, newton's convection: central with a small dissipation, or upwind (kappa = 1/3). */
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
    LIMIT_MOTION,
    LIMIT_OUTPUT
};

struct blocked_params; /* boundary/blocked.h */

/* The case as the run uses it: case/ writes it, all else reads it. */
struct fv_params {
    int cells[3];   /* of the uniform grid along each axis */
    double cfl;     /* of the largest sum over the axes of |u_a| dt/h_a; 0: the integrator's own */
    int integrator; /* enum fv_integrator */
    double tol_pressure; /* of the last projection of a step, relative to |div U*| */
    double tol_viscous;  /* of Helmholtz; 0: see helmholtz_tolerance */
    double tol_newton;   /* of a residual, as a velocity relative to the largest */
    int flux;            /* enum fv_flux; newton only */
    double c0;           /* m/s: sound speed; newton only, 0: incompressible */
    bool steady;         /* newton only: march to a steady state */
    bool dual_time;      /* newton only: pseudo steps instead of its linear systems */
    double pseudo_cfl;   /* -: length of a pseudo step, see newton_dual.c */
    int pseudo_steps;    /* at most, to a step */
    int pseudo_memory;   /* states that their acceleration remembers; 0: none */
    double graded[3];    /* m, rows: see rows.h; rows 0: all even */
    double hole[2][3];   /* box whose cells take the exact solution; all 0: none */
    double upwind;       /* C of the bias in convection.c; 0: none, -1: 1 with walls, else none */
    double dissipation;  /* of newton's convection on blocks, 0 for the others */
    double extrema[3];   /* m/s: known ones on the centre lines, see fv_lines.c; 0: none */
    int surface;         /* enum fv_surface */
    int volume;          /* enum fv_volume: how the surface keeps its water */
    double force[3]; /* N, N, 1/s: known mean along x, amplitude along y, its frequency; 0: none */
    /* what follows from these and from the scene */
    bool water;                         /* there is a free surface */
    bool errors;                        /* those against the exact solution are measured */
    bool ring;                          /* block 0 is a ring whose walls make Couette flow */
    struct mesh_blocks blocks;          /* n 0: cells */
    int nboxes;                         /* boxes cut out of cells */
    const struct blocked_params *boxes; /* borrowed from case/ for the whole run */
};

struct mesh_bc;        /* their sides; boundary/mesh_sides.h */
struct poisson;        /* poisson/poisson.h */
struct flow_ops;       /* operators/flow_ops.h */
struct viscous_solver; /* operators/viscous_solver.h; NULL: no viscosity */
struct moving;         /* blocks that move; time/moving.h; NULL: none do */
struct bc;             /* walls and openings; bc.h; NULL: none */
struct blocked;        /* boxes cut out; boundary/blocked.h; NULL: none */
struct forcing;        /* cells whose velocity is imposed; forcing.h; NULL: none */
struct outflows;       /* convective outflows; outflow.h; NULL: none */
struct levels;         /* openings of given pressure under a surface; levels.h; NULL: newton */
struct surface;        /* free surface; levelset.h; NULL: none */
struct newton;         /* the implicit integrator; newton.h; NULL: another one */
struct link;           /* place in a coupled job; fv_coupling.c; NULL alone */
struct watches;        /* figures that a sound run keeps small; watches.h */
struct fv_output;      /* what outputs keep from row to row; output/output.h */

/* Gravity as the equations hold it; boundary/still.h. */
struct gravity {
    double periodic[3];    /* m/s^2: where it drives the flow, along periodic axes and channels */
    double hydrostatic[3]; /* m/s^2: across closed sides, where the pressure takes it up */
    double level;          /* m: height at which that pressure is 0 */
    int upright;           /* the axis that hydrostatic is most along; without any the last */
};

/* The step under way and the last ones; time/ makes them. */
struct fv_step {
    double dt_now;     /* s: of the step under way */
    double dt, dt_old; /* s: last step, 0 before the first; the one before it */
    enum limit limit;  /* what bounded the last one */
    double defect;     /* m^dim/s: largest net flux that an overlap makes in it */
    bool failed;       /* the pressure solver, in it */
    bool predicts;     /* its steps will be undone: nothing in them is to be judged or counted */
};

/* Largest of all cells and ranks, of the flow as it is; flow_ops' measure finds them. */
struct flow_maxima {
    double u[3]; /* m/s: |u_a|; on blocks {|u|, 0, 0} */
    double rate; /* 1/s: sum over the axes of |u_a|/h_a of a cell */
    double rise; /* 1/s^2: what forces add to it in a second; blocks */
    double Re;   /* |u| h/nu of a cell; blocks */
};

/* Velocities to expect, and the one that no flow of the scene has, and how fast viscosity takes
 * them away; watch/limits.h. */
struct fv_speeds {
    double scene;     /* m/s: limits_reference */
    double partner;   /* m/s: where the partner has bodies; 0: none */
    double reference; /* m/s: limits_follow */
    double limit;     /* m/s: beyond it the run has blown up */
    double decay;     /* 1/s: limits_decay */
};

/* What the whole run counts, for its last lines and its summary. */
struct fv_totals {
    int64_t iterations;         /* of the pressure solver */
    int64_t viscous_iterations; /* of Helmholtz */
    int64_t start_iterations;   /* of the pressure solver, before the first step */
    int64_t retries;            /* of the pressure solver, by the safer one; blocks */
    double defect;              /* m^dim/s: largest of fv_step's */
    double max_cfl;             /* -: largest sum over the axes of |u_a| dt/h_a */
    double fastest;             /* m/s: largest |u_a| in the rows of the series */
};

/* What the stages of a step leave to those of the next, and their scratch; time/stages.h. */
struct stage_fields {
    double *psi[3];          /* m^2/s^2: start of the next step's solve; rk3 and blocks: of each
                              * stage, bdf2 on uniform cells: the first */
    double *start[3];        /* blocks: what the solver iterates on, likewise */
    double *N[3], *N_old[3]; /* m/s^2: convection now and before (rk3: of a stage; bdf2: a step) */
    double *u_old[3];        /* m/s: of the step before; bdf2, newton; else NULL */
    double *step_p[3];       /* m/s^2: gradient of the pressure at the step's start */
    double implicit;         /* m^2: nu times the implicit part of the stage under way where that
                              * makes the step's pressure, else 0 */
};

/* On blocks that move, what the fringe has beyond its interpolation; else NULL; time/moving.h. */
struct fringe_jumps {
    double *psi;      /* m^2/s^2 */
    double *delta[3]; /* m/s */
    double *z;        /* psi of the volumes, without an outflow */
};

/* What a coupled job adds to the flow, all 0 alone; coupling/ fills it. */
struct fv_partners {
    int n;
    double box[PARTNERS_MAX][2][3]; /* m: that each counts as its own */
    bool moves[3];                  /* one of these moves along the axis */
    double pressure;                /* Pa: theirs over ours, to be added in output */
    double *past[2][3];  /* m/s: u where the last coupling step began and the one before; NULL: no
                          * box moves */
    unsigned char *born; /* of blocks with bdf2: 1: computed since born_at, when the box moved */
    double born_at;      /* s */
};

/* The state of a run on one rank. Made by fv_create, freed by fv_free (case/fv_case.h); each
 * pointer is owned, by the folder whose header the list above names, but for run and ops. */
struct fv {
    struct run *run;      /* borrowed from run_main */
    struct fv_params prm; /* a copy of what fv_params_of found */
    struct block b;       /* the uniform grid, or one of graded rows; empty with blocks */
    struct mesh *m;       /* the blocks; NULL: none */
    struct grid grid;     /* either of them, to those who need not tell which: parts of this rank */
    int dim;
    MPI_Comm comm;              /* that of the grid: its ranks may have another order than run's */
    int64_t size;               /* entries of a field, ghosts included */
    struct part whole;          /* that of the uniform grid */
    const struct flow_ops *ops; /* the operators of this kind of cells */
    struct exact exact;         /* the scene's field, which errors and exact sides refer to */
    double nu;                  /* m^2/s */
    struct gravity gravity;
    double t; /* s */
    struct fv_step step;
    struct flow_maxima max;
    struct fv_speeds speed;
    struct fv_totals totals;
    double *u[3];     /* m/s: cell averages, with ghosts */
    double *p;        /* m^2/s^2: p/rho, of the last step's end (rk3: at t - dt/6) */
    double *p_before; /* of the step before */
    double *U[3]; /* m/s, on blocks m^dim/s: projected flux through the lower face of each cell */
    struct stage_fields stages;
    struct viscous_solver *viscous;
    double *rhs[3], *delta[3]; /* scratch: right side, increment */
    double *faces[3], *flux;   /* scratch of what stands on faces; uniform cells: the first alone */
    struct moving *moving;
    struct fringe_jumps fringe;
    double *free; /* blocks: 1: computed, 0: not */
    struct bc *bc;
    struct blocked *blocked;
    struct forcing *forcing;
    struct wave_zones *wave_zones; /* common/scene/wave_zones.h; NULL: none */
    struct zone_cells *zone_cells; /* those that it relaxes (time/relax.c) */
    struct outflows *outflows;
    struct levels *levels;
    struct surface *surface;
    struct mesh_bc *sides;
    struct poisson *poisson;
    struct newton *newton;
    struct link *link;
    struct fv_partners partners;
    struct watches *watches;
    struct fv_output *output;
};

/* Of what a step starts from (time/fv_keep.c), at most: fields and single numbers. */
enum { FV_RESTART_FIELDS = 40, FV_RESTART_NUMBERS = 48 };

/* Rows of all cells of this rank: c is the place of a row's first cell, len its length. */
#define FLOW_ROWS(s, c, len) FLOW_ROWS_AT (s, its_part_##c, its_row_##c, c, len)
/* The same for those who want the part (part) and the row's place along y in it (j), too. */
#define FLOW_ROWS_AT(s, part_, j, c, len)                                                          \
    for (const struct part *part_ = (s)->grid.part; part_ < (s)->grid.part + (s)->grid.nparts;     \
         part_++)                                                                                  \
        for (int its_layer_##c = 0, j; its_layer_##c < part_->n[2]; its_layer_##c++)               \
            for (j = 0; j < part_->n[1]; j++)                                                      \
                for (int64_t c = part_at(part_, 0, j, its_layer_##c), len = part_->n[0],           \
                             its_once_##c = 1;                                                     \
                     its_once_##c; its_once_##c = 0)

/* The same of cells near water alone: of all without a surface. Elsewhere velocity, fluxes and
 * pressure are 0, and phi is beyond its band. WET: of water and one cell around, for what
 * extension_apply makes anew in the air, or no one reads there. */
#define FLOW_NEAR(s, c, len) FLOW_RUNS_AT(s, near, its_part_##c, its_row_##c, c, len)
#define FLOW_NEAR_AT(s, part_, j, c, len) FLOW_RUNS_AT(s, near, part_, j, c, len)
#define FLOW_WET(s, c, len) FLOW_RUNS_AT(s, wet, its_part_##c, its_row_##c, c, len)
#define FLOW_RUNS_AT(s, runs, part_, j, c, len)                                                    \
    for (const struct part *part_ = (s)->grid.part; part_ < (s)->grid.part + (s)->grid.nparts;     \
         part_++)                                                                                  \
        for (int its_layer_##c = 0, j; its_layer_##c < part_->n[2]; its_layer_##c++)               \
            for (j = 0; j < part_->n[1]; j++)                                                      \
                for (int64_t                                                                       \
                         c = part_at(part_, part_first(part_, part_->runs, 0, j, its_layer_##c),   \
                                     j, its_layer_##c),                                            \
                         len = part_count(part_, part_->runs, 0, 0, j, its_layer_##c),             \
                         its_once_##c = 1;                                                         \
                     its_once_##c; its_once_##c = 0)
/* Rows of the uniform grid, `more' layers around, likewise. */
#define BLOCK_NEAR(s, more, c, len) BLOCK_RUNS_AT(s, near, more, its_row_##c, c, len)
#define BLOCK_NEAR_AT(s, more, j, c, len) BLOCK_RUNS_AT(s, near, more, j, c, len)
#define BLOCK_WET(s, more, c, len) BLOCK_RUNS_AT(s, wet, more, its_row_##c, c, len)
#define BLOCK_WET_AT(s, more, j, c, len) BLOCK_RUNS_AT(s, wet, more, j, c, len)
#define BLOCK_RUNS_AT(s, runs, more, j, c, len)                                                    \
    for (int its_layer_##c = (s)->whole.g[2] ? -(more) : 0, j;                                     \
         its_layer_##c < (s)->whole.n[2] + ((s)->whole.g[2] ? (more) : 0); its_layer_##c++)        \
        for (j = -(more); j < (s)->whole.n[1] + (more); j++)                                       \
            for (int64_t                                                                           \
                     c = part_at(&(s)->whole,                                                      \
                                 part_first(&(s)->whole, (s)->whole.runs, more, j, its_layer_##c), \
                                 j, its_layer_##c),                                                \
                     len = part_count(&(s)->whole, (s)->whole.runs, more, more, j, its_layer_##c), \
                     its_once_##c = 1;                                                             \
                 its_once_##c; its_once_##c = 0)

/* m/s: the largest |u| on blocks, component of u on uniform cells, of all ranks. */
static inline double fv_fastest(const struct fv *s)
{
    return fmax(s->max.u[0], fmax(s->max.u[1], s->max.u[2]));
}
/* The box of fv.hole, lower and upper corner; NULL: none. */
static inline const double (*fv_hole(const struct fv_params *p))[2][3]
{
    return p->hole[1][0] > p->hole[0][0] ? (const double(*)[2][3]) & p->hole : NULL;
}
#endif
