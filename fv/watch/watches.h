/* watches.h - figures that a sound flow keeps small: energy gained beyond its budget, waves of two
 * cells, sudden growth of the largest velocity, volume that the level set lost and got back.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/run/run.h"
#include "../fv.h"

/* Sums over all ranks and all cells that are computed, over rho. */
struct flow_energy {
    double kinetic;     /* m^(dim+2)/s^2 */
    double momentum[3]; /* m^(dim+1)/s */
    double volume;      /* m^dim */
    double power;       /* m^(dim+2)/s^3: what comes in through sides and by gravity */
};
/* Sums of squares of the waves of two cells along each axis, and of what they are waves of. */
struct flow_waves {
    double velocity, velocity_all; /* m^(dim+2)/s^2 */
    double pressure, pressure_all; /* m^(dim+4)/s^4: about the mean */
};

/* The figures and what they are judged by; the same on all ranks. */
struct watches {
    struct watch energy, velocity, pressure, growth, returned;
    bool has_energy, has_growth, has_surface, periodic;
    bool filled;                       /* that no surface is left was told */
    bool dry;                          /* and that no cell holds water */
    bool lidded;                       /* that water is at a side that fv closes was told */
    int energy_every, waves_every;     /* steps */
    struct watch_budget budget, peaks; /* of the energy less work; its largest so far */
    double speed;                      /* m/s: of the scene */
    double damping;                    /* 1/s: of the slowest wave by viscosity, pi^2 nu/L^2 */
    double work, power, t;             /* m^(dim+2)/s^2, of the last look, its time */
    double work_least, work_most, kinetic_most;
    /* m^2/s^3: work over rho and volume of zones that make waves under a surface, at the end of a
     * step (relax.c); NULL: there are none. */
    double *zone_power;
    double balance; /* m^(dim+2)/s^2: kinetic energy less the work, of the last look */
    double least;   /* with a surface: of the energy that the scene's velocity makes, what counts */
    double least_square; /* of the scene's velocity squared, what counts at least */
    double sound; /* m/s: of a partner whose fluid is compressible and at rest in water at rest, a
                     hundredth of its speed of sound; times rho u the least pressure that counts */
    struct flow_waves waves, waves_before; /* what counted at the last look, and at that before */
    double waves_t;                        /* s: of the last */
    int looks;
    double sum_before; /* m/s: of the largest velocities, a step ago */
};

/* The figures that apply to a flow on these parameters, as the run uses them; periodic: nothing
 * but periodic axes bounds it; surface: it has a free surface. Owned by the caller (FREE).
 */
struct watches *watches_create(const struct run *r, const struct fv_params *p, bool periodic,
                               bool surface);
/* Says that the flow has inlets or outlets, whose work is known less exactly: a gain of energy then
 * warns and ends no run. */
void watches_open(struct watches *w);
/* Whether the energy is to be measured after this step. */
bool watches_want_energy(const struct watches *w, int64_t step);
/* Whether waves of two cells are to be measured after this step. */
bool watches_want_waves(const struct watches *w, int64_t step);
/* Judges the energy e after step number `step' at time t, s, and sets d where it has grown beyond
 * what sides and gravity have brought in. */
void watches_energy(struct watches *w, const struct flow_energy *e, double t, int64_t step,
                    struct diagnosis *d);
/* Judges the waves of two cells in a flow of this volume, m^dim, likewise. */
void watches_waves(struct watches *w, const struct flow_waves *v, double volume, double t,
                   int64_t step, struct diagnosis *d);
/* Judges the growth of the flow since the last step; sum: of the largest |u_a| over the axes,
 * m/s. */
void watches_growth(struct watches *w, double sum, double t, int64_t step, struct diagnosis *d);

/* Adds the columns that the series has of these figures. */
void watches_row(const struct watches *w, struct figures *to);
/* Adds the worst values to the summary, and "not_accepted" where the surface has lost and got back
 * too much water. */
void watches_summarise(const struct watches *w, struct summary *to);
struct h5;
/* The worst values in a restart file, written or read; budgets start anew. */
void watches_restart(struct watches *w, struct h5 *f);

/* fv_watches.c: the figures of a state on any grid. Collective, as the next two. */
struct watches *fv_watches_create(const struct fv *s);
/* Measures and judges after a step what is due, and sets d if the run must end. */
void fv_watches_look(struct fv *s, struct diagnosis *d);
/* Measures once more at the end of the run and writes the summary. */
void fv_watches_end(struct fv *s);
