/* watches.h - figures that a sound flow keeps small: energy gained beyond its budget, waves of two
 * cells, sudden growth of the largest velocity, volume that the level set lost and got back.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_WATCHES_H
#define FV_WATCHES_H

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

struct watches {
    struct watch energy, velocity, pressure, growth, returned;
    bool has_energy, has_growth, has_surface, periodic;
    bool filled;                       /* that no surface is left was told */
    bool lidded;                       /* that water is at a side that fv closes was told */
    int energy_every, waves_every;     /* steps */
    struct watch_budget budget, peaks; /* of the energy less work; its largest so far */
    double speed;                      /* m/s: of the scene */
    double damping;                    /* 1/s: of the slowest wave by viscosity, pi^2 nu/L^2 */
    double work, power, t;             /* m^(dim+2)/s^2, of the last look, its time */
    double work_least, work_most, kinetic_most;
    double balance; /* m^(dim+2)/s^2: kinetic energy less the work, of the last look */
    double least;   /* with a surface: of the energy that the scene's velocity makes, what counts */
    double least_square; /* of the scene's velocity squared, what counts at least */
    struct flow_waves waves, waves_before; /* of the last look at them, and of that before */
    double waves_t;                        /* s: of the last */
    int looks;
    double sum_before; /* m/s: of the largest velocities, a step ago */
};

/* p: as the run uses them. */
struct watches *watches_create(const struct run *r, const struct fv_params *p, bool periodic,
                               bool surface);
void watches_open(struct watches *w); /* the flow has inlets or outlets */
void watches_free(struct watches **w);
/* Whether this step is one to look at. */
bool watches_want_energy(const struct watches *w, int64_t step);
bool watches_want_waves(const struct watches *w, int64_t step);
void watches_energy(struct watches *w, const struct flow_energy *e, double t, int64_t step,
                    struct diagnosis *d);
void watches_waves(struct watches *w, const struct flow_waves *v, double volume, double t,
                   int64_t step, struct diagnosis *d);
/* sum: of the largest |u_a| over the axes. */
void watches_growth(struct watches *w, double sum, double t, int64_t step, struct diagnosis *d);

/* Columns of the series (static names), their values; worst values into the summary, and what is
 * not to be accepted. */
int watches_columns(const struct watches *w, const char **columns);
int watches_values(const struct watches *w, double *values);
void watches_summarise(const struct watches *w, struct summary *to);
/* Worst values to and from a restart file. */
struct h5;
void watches_save(struct watches *w, struct h5 *f);
void watches_load(struct watches *w, struct h5 *f);

/* fv_watches.c: all of them, after a step on any grid. */
struct watches *fv_watches_create(const struct fv *s);
void fv_watches_look(struct fv *s, struct diagnosis *d);
void fv_watches_end(struct fv *s); /* the state that is left; collective, as all */

#endif
