/* scene.h - the groups of a case that every program reads: what is computed, not how.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_H
#define COMMON_SCENE_H

#include <stdbool.h>

#include "params.h"

enum initial_field { FIELD_REST, FIELD_UNIFORM, FIELD_TAYLOR_GREEN, FIELD_TWO_MODES };
enum { ACCEPT_MAX = 16, SCENE_GROUPS = 7 };

struct scene {
    struct scene_time {
        double end; /* s */
    } time;
    struct scene_fluid {
        double rho;        /* kg/m^3 */
        double nu;         /* m^2/s; 0: inviscid, nothing viscous is computed */
        double gravity[3]; /* m/s^2 */
    } fluid;
    struct scene_domain {
        int dim;               /* 2 or 3 */
        double min[3], max[3]; /* m */
        bool periodic[3];
    } domain;
    struct scene_initial {
        int field;          /* enum initial_field */
        double U, L;        /* m/s, m: scales of the field; errors are relative to them */
        double velocity[3]; /* m/s: uniform velocity, or the one that carries two_modes */
    } initial;
    struct scene_coupling {
        int steps;         /* SPH steps in a window */
        double transition; /* m; 0: 1.25 R */
        double buffer;     /* m; 0: 1.25 R */
        double overlap;    /* m; 0: 1.25 R: of the free zone, outside the forced cells */
        int memory;        /* windows over which the rate of change of pressure is averaged */
        int mapping;       /* 0 shepard, 1 mls: particles to forced cells */
        int interpolation; /* 0 linear, 1 cubic: patch to particles */
        double deadline;   /* s to meet the other programs */
    } coupling;
    struct scene_output {
        double every;                 /* s between snapshots; 0: first and last only */
        bool snapshots;               /* write HDF5 at all */
        char fields[PARAM_TEXT_SIZE]; /* "velocity pressure ..." */
        int series;                   /* steps between rows of series.csv */
        double checkpoint;      /* s of simulated time between restart files; 0: only at a stop */
        double checkpoint_wall; /* s of wall time between restart files; 0: none */
    } output;
    int naccept;
    struct scene_accept {
        char what[PARAM_TEXT_SIZE]; /* key of summary.json: "error.velocity_l2" */
        double tolerance;           /* accepted while the value is at most this */
    } accept[ACCEPT_MAX];
    bool has_coupling, has_output;
    bool has_sph, has_fv; /* groups of the solvers: both make a coupled job */
};

/* The table of the groups above, with s as target: fills groups[SCENE_GROUPS]. */
void scene_groups(struct scene *s, struct param_group *groups);
/* Faults between keys (max > min, L > 0, ...). */
void scene_check(const struct scene *s, const struct params *p, struct faults *f);

#endif
