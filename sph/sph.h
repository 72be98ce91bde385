/* sph.h - the whole state of the SPH solver and what its modules offer each other.
 * Equations: Chiron, thesis, Ecole Centrale de Nantes 2017, chapters 1-2, cited as [2.x].
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SPH_H
#define SPH_SPH_H

#include <stdbool.h>
#include <stdint.h>

#include "../common/base/fit.h"
#include "../common/run/run.h"
#include "../common/scene/scene_speed.h"
#include "particles/particles.h"
#include "watch/sph_watch.h"

/* Vila [2.86-2.89]; Leduc [2.96-2.99]; Antuono [2.60-2.63]; [2.47-2.50] with [2.58-2.59] */
enum sph_scheme { SCHEME_RIEMANN_ALE, SCHEME_RIEMANN, SCHEME_DELTA, SCHEME_STANDARD, SCHEME_AUTO };
enum sph_limiter { LIMITER_KOREN, LIMITER_MINMOD, LIMITER_NONE };
enum sph_transport {
    TRANSPORT_TVS,
    TRANSPORT_TVO,
    TRANSPORT_NONE,
    TRANSPORT_EULERIAN,
    TRANSPORT_XSPH
};
enum sph_viscosity {
    VISCOSITY_MORRIS,
    VISCOSITY_MONAGHAN,
    VISCOSITY_AUTO
}; /* auto: in cases only */
enum sph_outer { OUTER_NONE, OUTER_EXACT, OUTER_PARTNER, OUTER_SIDES };
enum sph_walls { WALLS_NFM, WALLS_GHOSTS, WALLS_AUTO };
enum sph_integrals { INTEGRALS_CLOSED, INTEGRALS_CLIPPED, INTEGRALS_CENTROIDS };
enum sph_integrator { INTEGRATOR_RK4, INTEGRATOR_J3, INTEGRATOR_AUTO }; /* time/runge_kutta.h */
enum sph_surface { SURFACE_NO, SURFACE_YES, SURFACE_AUTO };

struct sph_params {
    double dx;    /* m */
    double R_dx;  /* support radius over dx, - */
    double c0;    /* m/s; 0: ten times the speed that the scene lets expect */
    double gamma; /* Tait's exponent, 7 or 1 */
    int scheme, limiter, transport, viscosity;
    bool low_dissipation; /* bounded Riemann dissipation (Zhang, Hu & Adams 2017) */
    double dissipation;   /* its least share then */
    double damper;        /* acoustic damper beta, 0: off */
    double alpha, delta;  /* of schemes delta and standard: [2.58, 2.62], [2.60] for R */
    bool background;      /* pressure that lifts the least one to 0 [2.105] */
    int integrator;       /* enum sph_integrator */
    double cfl;           /* CFL_a of [2.102] */
    double cfl_viscous;   /* CFL_v of [2.103] */
    double box[2][3];     /* outer face of the buffer; all 0: the whole domain, no zones */
    double free[2][3];    /* instead of box: the free zone; box is the widths of the zones larger */
    double box_velocity[3];   /* m/s */
    char box_follows[128];    /* name of a body, "": none */
    int walls;                /* enum sph_walls */
    int wall_integrals;       /* enum sph_integrals */
    int wall_squares;         /* along each side, of clipped ones */
    int surface;              /* enum sph_surface: the fluid has a free surface */
    int outer;                /* what feeds the zones: none, exact, partner */
    double density_limit;     /* |rho/rho0 - 1| that ends the run; 0: as the flow has it */
    int packing;              /* steps; -1: as the walls need it */
    double noise;             /* random displacement of the first lattice, in dx */
    double expected;          /* m/s: speed to expect, a tenth of the default c0; no key */
    struct scene_speed speed; /* what the scene lets expect of its velocities; no key */
    double extrema[3];        /* m/s: known ones on the centre lines, see sph_lines.c; 0: none */
};

struct sph;
struct neighbours; /* cell grid and list of pairs; neighbours.h */
struct domain;     /* partition over ranks, migration, halo; domain.h */
struct walls;      /* walls and bodies; walls.h; NULL: none */
struct surface;    /* free surface; surface.h; NULL: none */
struct stages;     /* scheme in time; time/runge_kutta.h */
struct refinement; /* regions and guards; refinement/refinement.h; NULL: none */
struct guards;     /* of one level; refinement/guards.h */
struct mixed;      /* particles of different sizes; refinement/mixed.h; NULL: all of one */
struct zones;      /* transition, buffer, openings; zones.h; NULL: none */

/* The two passes of a pair interaction; scheme.h. */
struct scheme {
    const char *name;
    void (*gradients)(struct sph *s); /* NULL: the scheme needs none */
    void (*rates)(struct sph *s);
    bool slopes; /* the second pass loads those of neighbours, so ghosts must have them */
};

struct sph {
    struct run *run;
    struct sph_params prm;
    int dim;
    double R, dx, dxD; /* m, m, m^dim: volume of a particle at the start */
    double rho0, nu, c0, gamma;
    double gravity[3], central; /* m/s^2, 1/s */
    double lo[3], hi[3];        /* region of the particles: the domain, or sph.box */
    bool periodic[3];           /* of that region */
    bool open[6];     /* its sides (2a: low, 2a+1: high) where particles come and go; zones.h */
    int level;        /* of refinement: dx = dx_0/2^level */
    bool local_steps; /* each level steps with a time step of its own */
    struct sph *coarser, *finer; /* the levels next to this one; NULL: none. The coarsest stands
                                    for all of them; what is of the whole flow is its own */
    double t;                    /* s: time of the state y; during a stage: of that stage */
    double dt;                   /* s: of the last step of this level; y0 is the state before it */
    struct particles p;
    struct neighbours *list;
    struct domain *domain;
    struct scheme passes;        /* what the parameters name */
    const struct scheme *scheme; /* &passes */
    const struct stages *stages; /* borrowed for ever */
    struct zones *zones;
    struct walls *walls;
    struct surface *surface;
    struct refinement *refinement; /* of all levels: the coarsest has it */
    /* Whether it is this level that flows at x; NULL: there is one level. refinement.h */
    bool (*flows_at)(const struct sph *s, const double *x);
    struct guards *guards;
    struct mixed *mixed;
    double background; /* Pa: of this stage [2.105] */
    double skin;       /* m: the list holds pairs within R + skin */
    double skin_most;  /* m: what ghosts are prepared for, and half a period has room for */
    bool ready;        /* list and ghosts belong to the positions of y; whoever moves, adds or
                          removes particles outside a step clears it */
    bool sloped;       /* prim and slope, too, and the next stage may take them as they are */
    bool packing;      /* the first lattice is being rearranged, nothing flows */
    bool broken;       /* the state cannot be trusted: no list is made of it any more */
    int64_t next_id;   /* of the next particle born on this rank: rank + k size */
    /* of the last step, over all ranks */
    double max_speed, max_shift, rho_min, rho_max, max_c;
    const char *limited_by; /* "sound", "viscosity", "speed", "body" or "region" */
    int limited_level;      /* at which level the step is bound */
    double signal;          /* m/s: max of c + |u - u0| */
    double shift_speed;     /* m/s: U of the laws of shifting: largest |u| so far, without walls
                               relative to the drift; with walls at least nu/R */
    double drift[3], stray; /* m/s: middle of the velocities u0, largest distance from it */
    double dt_most;         /* s: largest next step [2.102-2.104] */
    double max_mach;        /* since the start: |u|/c0 */
    double fluctuation, fluctuation_particles; /* since the start, with zones: |M/mass0 - 1|, with
                                  and without the mass that faces hold */
    double lost,
        lost_said; /* particles removed since the start: this rank; all, when last reported */
    int64_t pairs; /* ordered pairs within R, counted once a stage, summed over stages; this rank */
    int64_t pairs_now;     /* the same, of the present list */
    struct fit signal_fit; /* of a standing wave or of the drop, sampled with the series */
    double mass0, energy0, momentum0[3]; /* at t = 0, for drifts */
    double volume0;                      /* m^dim: of a closed room, kept; 0: not closed */
    double mass; /* kg: with refinement, of the fluid after the last step, this rank. Levels take
                    over from each other across a spacing of the coarser one, lest a row of a
                    lattice that passes there count at once */
    /* Force on the first body over the second half of the run: length of the sampled time,
     * integrals of F and of |F|^2; the same from the averaged wall pressure, of rows: last time,
     * length, integral of F. */
    double force_time, force_sum[3], force_sum2;
    double average_t, average_time, average_sum[3];
    double mach_late; /* max |u|/c0 over the second half */
    struct sph_watch watch;
    double wall_s, cpu_s; /* s: of all steps; this rank */
};

/* sph_state.c: prm as sph_params_of gives it, copied; f: restart file, then r->t and r->step are
 * set, or NULL. NULL: f does not fit. Collective over r->comm. */
struct sph *sph_create(struct run *r, const struct sph_params *prm, struct h5 *f);
void sph_free(struct sph **s);

/* volume.c: at the start, of a fluid of this volume; after the stages of every step; where levels
 * have exchanged particles, what is kept from then on; or before that is kept, what an exchange
 * within the step has added, m^dim, on this rank. Collective. */
void volume_remember(struct sph *s, double volume);
void volume_change(struct sph *s, double by);
void volume_keep(struct sph *s);
void volume_renew(struct sph *s);

/* pack.c: steps of rearrangement of the first particles between walls; 0: none. Collective. */
void pack_start(struct sph *s, int steps);
/* Of a finer level, but for those at its edge, after its birth of one that was packed. */
void pack_finer(struct sph *level);

/* fill.c: whether there is fluid at x at the start, and the velocity that its shape adds. */
struct exact;
struct fill; /* the lattice and its waters, for the finer levels; NULL: there is none */
/* lattice at cell centres in [lo, hi], exact u and p at t = 0, w = dx^D, m = rho(p) w. */
struct fill *fill_lattice(struct sph *s);
void fill_free(struct fill **f);
/* Cells of that lattice along an axis of a region from lo to hi, m, and its lower end along axis a:
 * from the lower corner; from the upper one where only that has a wall of the domain. The last
 * cell may reach out of a domain that dx does not divide. */
double fill_lattice_cells(double lo, double hi, double dx);
double fill_lattice_begin(const struct scene *c, int a, double lo, double hi, double dx);
/* The first particles of the finer levels: born of the coarser ones, with the exact field. */
void fill_finer(struct sph *s, const struct fill *f);
/* Whether walls and bodies leave room for a particle of this level at x. */
bool fill_has_room(const struct sph *s, const double *x);
/* Adds the first particle at x with the velocity and pressure of the case there; volume: over
 * dx^dim. Returns its place. */
int fill_add(struct sph *s, const struct exact *e, int64_t id, const double *x, double volume);
/* Cells of the first lattice of s, the coarsest level, in and around this rank's part of a domain:
 * their centres, m. */
void fill_each_near(const struct sph *s, const struct domain *part,
                    void (*at)(const double *centre, double dx, void *ctx), void *ctx);
/* Takes out the locals that packing has pressed into seams of walls narrower than dx. */
void fill_clear_seams(struct sph *s);

/* integrate.c: one step of at most dt_max; see program.step. */
double integrate_step(struct sph *s, double t_stop, struct diagnosis *d);
/* Neighbour list and halo of the present positions, then rates of y at s->t (what a stage does). */
void integrate_prepare(struct sph *s);
void integrate_rates(struct sph *s);
/* prim and slope of the present state, for output and errors; what is imposed from outside stays
 * out. */
void integrate_gradients(struct sph *s);
/* First time step, skin and extremes from the state at t = 0. */
void integrate_start(struct sph *s);

/* sph_io.c, sph_errors.c */
/* Whether the scene has an exact solution at all times. */
bool sph_has_exact(const struct run *r);
/* Names of the columns that sph_row fills for this scene; returns their number, at most
 * SPH_COLUMNS. */
enum { SPH_COLUMNS = 56 + PROBES_MAX + 32 * BODIES_MAX };
int sph_columns(const struct run *r, const struct sph_params *prm, const char **names);
void sph_snapshot(void *s, struct h5 *f, struct xdmf *x, const char *file);
void sph_checkpoint(void *s, struct h5 *f);
bool sph_restore(struct sph *s, struct h5 *f);
void sph_finish(void *s);
void sph_row(void *s, double *values);
/* Sums over the free zone for the coupler; see program.tell. */
void sph_tell(void *s, struct summary *report);

/* sph_lines.c: extrema on the centre lines into the summary; 2D. Collective. */
void sph_summarise_extrema(const struct sph *s);

/* sph_coupling.c: the only file here that knows cpl.h. */
void coupling_check(const struct run *r, const struct sph_params *prm,
                    struct faults *f); /* coupling_check.c */
void coupling_warn(const struct run *r,
                   const struct sph_params *prm); /* of what is allowed, and better otherwise */
void coupling_offer(struct run *r,
                    const struct sph_params *prm); /* publishes sph.box and sph.free */
void sph_coupling_create(
    struct sph *s); /* declares sets and fields; s->zones->eval reads the patch */
void sph_coupling_free(struct sph *s);
void sph_coupling_window_begin(void *s, double t0, double t1);
void sph_coupling_window_end(void *s, double t1);

#endif
