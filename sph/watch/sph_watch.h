/* sph_watch.h - what is watched while particles run: energy against its budget, speeds against the
 * speed of sound, particles returned from behind walls, particles that pair up or overlap; and when
 * a state cannot be trusted, and why. The figures are those of common/run/watch.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/run/run.h"
#include "../../common/scene/scene.h"

struct sph;
struct sph_params;
struct h5;
struct run;
struct scene;

/* Which advice a message gives: a larger c0, a smaller dx, other walls, another scheme. */
enum sph_watch_remedy { REMEDY_C0, REMEDY_DX, REMEDY_WALLS, REMEDY_SCHEME, REMEDIES };
enum sph_watch_kind {
    SPH_WATCH_MACH,
    SPH_WATCH_ENERGY,
    SPH_WATCH_PAIRED,
    SPH_WATCH_PUT_BACK,
    SPH_WATCH_CROWDED,
    SPH_WATCH_FORCES,
    SPH_WATCHES
};
/* Energies are taken every SPH_WATCH_EVERY steps, the others every multiple of that. */
enum {
    SPH_WATCH_EVERY = 10,
    SPH_WATCH_FORCES_EVERY = 20,
    SPH_WATCH_PAIRS = 50,
    SPH_WATCH_SUMS = 9
};

/* crowding.c, of a refined flow, this rank: number of particles of all levels that count, number of
 * those that overlap, the largest sum w W with its position, m, and level. */
struct sph_crowd {
    double counted, crowded, most, place[3]; /* -, -, -, m */
    int level;                               /* of the particle with the largest sum */
};

/* rest_forces.c: for a body, the number of samples in a row at which it was at rest; the same on
 * all ranks. */
struct rest_forces {
    int n, body;
    double off[3], pushed; /* N: sums of force less average, and of pressure times area */
    double pressure;       /* Pa: mean over the surface at the last sample; 0: there was none */
    double share;          /* -: the first over the second */
};

/* sound.c: the mean velocity of the fluid, m/s, within the period of a sound wave from inflow to
 * outflow and back, twice. */
struct sph_sound {
    bool on;
    double period, from;      /* s: its length, its start */
    double least[3], most[3]; /* m/s */
    double swing;             /* m/s: half of the largest range of the last whole period; 0: none */
    int n;                    /* samples in it */
};

/* All watches of a run. The coarsest level has it. */
struct sph_watch {
    struct watch of[SPH_WATCHES];
    char remedy[REMEDIES][160];           /* by enum sph_watch_remedy */
    struct sph_crowd crowd;               /* at the last sample */
    char crowd_place[256];                /* where that was, in words */
    struct rest_forces still[BODIES_MAX]; /* of bodies that are at rest */
    char still_place[400];                /* which of them is off most, in words */
    struct sph_sound sound;
    bool budget_closed; /* all work done on the flow is known, so that its energy is judged */
    double reference;   /* m/s: largest speed that the scene lets expect */
    double rest;        /* -: static pressure over rho0 c0^2, the compression at rest */
    double friction;    /* the same of the pressures of slow viscous flow */
    double settles;     /* m^2/s^2: energy per mass that a layer of water gains by settling */
    struct watch_budget budget; /* of the energy less the work */
    double work;                /* J: done on the flow from outside since the start, all ranks */
    double power, power_t;      /* W, s: at the last sample */
    /* At the last samples: number of all particles returned so far; magnitude of the moving walls'
     * work and a fifth of the energy removed, J. */
    double put_back[WATCH_STEPS / SPH_WATCH_EVERY], passed[WATCH_STEPS / SPH_WATCH_EVERY];
    double removed; /* J: energy of particles removed since the last sample; this rank */
    /* The sample of this step, this rank's part until it is judged. */
    bool due; /* the step takes a sample */
    double sums[SPH_WATCH_SUMS];
    double wall_power; /* W: of the moving walls in this stage; this rank */
    double wall_work;  /* J: theirs since the last sample; this rank */
    double *rate;      /* [n][dim] momentum rates before the walls' part; NULL: not wanted */
};

/* Sets levels, texts and references of all watches from the parameters and the scene. */
void sph_watch_create(struct sph *s);
/* At the start of a step: sets whether it takes a sample. */
void sph_watch_begin(struct sph *s);
/* Whether walls or bodies of the scene move (wall_work.c). */
bool sph_watch_moves(const struct scene *c);
/* Called before and after the walls' part of the rates, whose power is the difference. */
void sph_watch_before_walls(struct sph *s);
void sph_watch_after_walls(struct sph *s);
/* After the rates of a stage that counts for `weight', s, of the step: adds the walls' work; in the
 * first stage of a step that takes a sample also the sums over this rank's particles. */
void sph_watch_stage(struct sph *s, bool first, double weight);
/* crowding.c: the figures of the present list and records, this rank. */
struct sph_crowd sph_watch_crowd(const struct sph *s);
/* Writes where it is worst, and what to do, to text[size]; the same on all ranks. Collective. */
void sph_watch_say_crowd(const struct sph *s, char *text, size_t size);
/* rest_forces.c: whether forces on bodies at rest are compared with averages of the pressure. */
bool sph_watch_has_forces(const struct run *r, const struct sph_params *prm);
/* Takes a sample of that at t, s, and judges it. Collective. */
void sph_watch_rest_forces(struct sph *s, double t, struct diagnosis *d);
/* sound.c: sets whether the run has an inflow and an outflow between which sound may stay, and the
 * period; restarts measure anew. */
void sph_sound_create(struct sph *s);
/* Takes a sample of the state. Collective. */
void sph_sound_judge(struct sph *s);
/* Writes the pressure of that sound, Pa, and warns of one that is as large as the flow's. */
void sph_sound_summarise(const struct sph *s);
/* Local particle i is about to be removed: its energy leaves the budget. */
void sph_watch_removed(struct sph *s, int i);
/* After the step: judges all watches that are due and fills d; the same on all ranks.
 * Collective. */
void sph_watch_judge(struct sph *s, struct diagnosis *d);
/* Adds the columns of those that have none of their own elsewhere. */
void sph_watch_row(const struct sph *s, struct figures *to);
/* Writes the figures to the summary. */
void sph_watch_summarise(const struct sph *s);
/* Writes budget, work and the worst values to a restart file. */
void sph_watch_save(const struct sph *s, struct h5 *f);
/* Reads them back; false: the file does not have them. */
bool sph_watch_load(struct sph *s, struct h5 *f);

/* sph_fault.c: how far a record y of the state is beyond its limits, as a multiple of them (1e300:
 * not finite), with its speed, m/s, and density, kg/m^3. Compression up to twice that of an impact
 * at the largest speed so far is legal, at most 0.5: a jet of Mach number Ma that meets a wall
 * raises rho by the fraction Ma (rho c U over rho c^2), in a corner twice. */
double sph_fault_of(const struct sph *s, const double *y, double *speed, double *rho);
/* Fills d with the worst particle of all ranks, named by its position, and the likely cause by what
 * is measured there; the same on any number of ranks. y0 must be the state before the step.
 * Collective. */
void sph_fault_diagnose(struct sph *s, struct diagnosis *d);
/* Fills d->where alone, with the particle that is nearest to its limits. Collective. */
void sph_fault_place(struct sph *s, struct diagnosis *d);
