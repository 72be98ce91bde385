/* sph.h - the whole state of the SPH solver, weakly compressible with explicit steps, and the types
 * that its modules share. One struct sph is one size level of particles on one rank; without
 * refinement there is one. Equations: Chiron, thesis, Ecole Centrale de Nantes 2017, chapters 1-2,
 * cited as [2.x]. Lengths are in m, and in 2D masses and forces are per metre of depth; m^dim
 * stands for m^2 or m^3.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SPH_H
#define SPH_SPH_H

#include "../common/base/base.h"
#include "../common/run/run.h"
#include "../common/scene/scene.h"
#include "particles/particles.h"
#include "sph_parameters.h"
#include "watch/sph_watch.h"

struct neighbours;   /* cell grid and list of pairs; neighbours.h */
struct domain;       /* partition over ranks, migration, halo; domain.h */
struct walls;        /* walls and bodies; walls.h; NULL: none */
struct free_surface; /* free surface; surface.h; NULL: none */
struct rk_stages;    /* scheme in time; time/runge_kutta.h */
struct refinement;   /* regions and guards; refinement/refinement.h; NULL: none */
struct guards;       /* of one level; refinement/guards.h */
struct mixed;        /* particles of different sizes; refinement/mixed.h; NULL: all of one */
struct zones;        /* transition, buffer, openings; zones.h; NULL: none */

/* The two passes of a pair interaction; scheme.h says what each computes. */
struct scheme {
    const char *name;                 /* as in the case: "riemann_ale" */
    void (*gradients)(struct sph *s); /* first pass; NULL: the scheme needs none */
    void (*rates)(struct sph *s);     /* second pass */
    bool slopes; /* the second pass reads the slopes of neighbours, so ghosts must have them */
};

/* What is known of the list of pairs and of the slopes, for the positions in p.y. */
struct list_state {
    double skin;      /* m: the list holds pairs within R + skin */
    double skin_most; /* m: what ghosts are prepared for, and half a period has room for */
    /* List and ghosts belong to the positions of y. Whoever moves, adds or removes particles
     * outside of the stages clears it. */
    bool ready;
    /* Prim and slope belong to y as well, and the next stage may take them as they are. */
    bool sloped;
    /* -: the second moment of supports that scales friction of pairs, 1 in a continuum, on average
     * of this list; 0: not known. Before that the sum, in units of 2^-36, and number of those that
     * the first pass has met on this rank. kernel_sums.h */
    double moment;
    int64_t moments[2];
    bool pulled; /* what zones of waves want in this step is known: p.pull */
    bool broken; /* the state cannot be trusted: no list is made from it any more */
};

/* The last step of this level: extremes over all ranks (extremes.h), and the bounds of the next
 * one. */
struct sph_step {
    /* m/s: largest |u|, |u - u0|; kg/m^3: least and largest density; m/s: largest speed of
     * sound. */
    double max_speed, max_shift, rho_min, rho_max, max_c;
    const char *limited_by; /* "sound", "viscosity", "speed", "body" or "region" */
    int limited_level;      /* level whose particles bound the step */
    double signal;          /* m/s: max of c + |u - u0| */
    /* m/s: U of the laws of shifting. With walls and a Riemann scheme 0.1 c0; else the largest |u|
     * so far (without walls relative to the drift, with walls at least nu/R), at most 0.1 c0 or,
     * without walls, 0.2 c0. */
    double shift_speed;
    double drift[3], stray; /* m/s: middle of the range of the velocities u0 in each direction,
                               largest |u0 - drift| */
    double carried;         /* -: 1 where the drift carries all water alike, 0 where some part of it
                               nearly rests: what is left of the drift is motion */
    double dt_most;         /* s: largest next step [2.102-2.104] */
    /* kg: with refinement, of the fluid after the step, this rank. Levels take over from each other
     * across a width of one spacing of the coarser one, so that a lattice row that passes there
     * does not count at once. */
    double mass;
};

/* Force on the first body over the second half of the run: length of the sampled time, s, integrals
 * of F and of |F|^2; the same from the averaged wall pressure, row by row: last time, length,
 * integral of F. */
struct mean_force {
    double time, sum[3], sum2;
    double average_t, average_time, average_sum[3];
};

/* Sums and maxima over all steps since the start. */
struct sph_totals {
    double max_mach;  /* |u|/c0 */
    double mach_late; /* the same over the second half of the run */
    /* With zones: |M/mass - 1|, with and without the mass that the accumulators of boundary faces
     * hold. */
    double fluctuation, fluctuation_particles;
    double fallen[6];      /* kg: of this level, gone out through each side where water falls out or
                              that has no wall; this rank */
    double lost;           /* number of other particles removed; this rank */
    double lost_at[3];     /* m: the first of a level beyond a side; this rank */
    bool lost_any;         /* there is one */
    double lost_said;      /* of all ranks, when last reported */
    int64_t pairs;         /* ordered pairs within R summed over stages; this rank */
    int64_t pairs_now;     /* the same, of the present list */
    double wall_s, cpu_s;  /* s: of all steps; this rank */
    struct fit signal_fit; /* of a standing wave or of the drop, sampled with the series */
    struct mean_force mean_force;
};

/* The sums at t = 0, against which drifts are measured. */
struct sph_start {
    double mass, energy, momentum[3]; /* kg, J, kg m/s: of all ranks */
    bool shut;                        /* all water is one, which walls and bodies shut in */
    double volume; /* m^dim: of the fluid in a closed room, conserved by volume.h; 0: not closed */
};

/* Where a level flows: at x, m, or not; and without a jump, for sums, 0 to 1, a spacing of the
 * coarser level wide where two levels meet, whose shares add up to 1. refinement.h */
struct level_places {
    bool (*flows)(const struct sph *s, const double *x);
    double (*share)(const struct sph *s, const double *x);
};

/* One level of particles with all that acts on it. Made by sph_create, freed by FREE
 * (sph_state.h). */
struct sph {
    struct run *run;       /* borrowed from run_main */
    struct sph_params prm; /* a copy of what sph_params_of found */
    int dim;
    double R, dx, dxD; /* m: support radius of the kernel, spacing; m^dim: dx^dim, volume of a
                          particle at the start */
    double rho0, nu, c0, gamma;    /* kg/m^3, m^2/s, m/s; gamma: Tait's exponent */
    double gravity[3], central;    /* m/s^2; 1/s: W of the acceleration -W^2 x */
    struct wave_zones *wave_zones; /* before sides; NULL: none; owned */
    /* The linear part of the pressure that the particles leave out, with the gravity that belongs
     * to it: what comes in from sides and partners is reduced by it, outputs have it added. */
    struct scene_reference reference;
    double lo[3], hi[3]; /* m: region of the particles, the domain or sph.box, which may move */
    bool periodic[3];    /* of that region */
    bool open[6];        /* its sides (2a: low, 2a+1: high) where particles come and go; zones.h */
    int level;           /* of refinement: dx = dx_0/2^level */
    bool local_steps;    /* each level steps with a time step of its own */
    struct sph *coarser, *finer; /* the levels next to this one; NULL: none. The coarsest stands
                                    for all of them; what is of the whole flow is its own */
    double t;                    /* s: time of the state y; during a stage: of that stage */
    double dt;                   /* s: of the last step of this level; y0 is the state before it */
    struct particles p;          /* the particles themselves: particles/particles.h */
    struct neighbours *list;
    struct domain *domain;
    struct scheme passes;           /* what the parameters name */
    const struct scheme *scheme;    /* &passes */
    const struct rk_stages *stages; /* borrowed for ever */
    struct zones *zones;
    struct walls *walls;
    struct free_surface *surface;
    struct refinement *refinement;     /* of all levels: the coarsest has it */
    const struct level_places *places; /* where this level flows; NULL: there is one level */
    struct guards *guards;
    struct body_coupling
        *body_coupling; /* of a coupled job with bodies; NULL: none; coarsest level */
    struct mixed *mixed;
    double background; /* Pa: background pressure of this stage [2.105], added to every pair's */
    struct list_state lists;
    bool packing; /* the first lattice is being rearranged and nothing flows */
    struct sph_step step;
    struct sph_totals total;
    struct sph_start start;
    struct sph_watch watch;
};

#endif
