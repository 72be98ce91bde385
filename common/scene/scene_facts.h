/* scene_facts.h - what keys of the scene's groups may need of a run: facts that a program finds
 * out, for the conditions of params_use.h. A program has those that it does not judge.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../params/params.h"
#include "scene_groups.h"

enum scene_fact {
    FACT_SPH,        /* particles, maybe of a partner */
    FACT_FV,         /* cells, maybe of a partner */
    FACT_SPH_ALONE,  /* no cells */
    FACT_COUPLED,    /* both */
    FACT_SURFACE,    /* a free surface */
    FACT_FULL,       /* openings whose whole area is known: none, or cells */
    FACT_FRICTION,   /* no-slip walls that exert friction, or cells */
    FACT_VISCOUS,    /* viscosity */
    FACT_ZONES,      /* particles whose region has open sides */
    FACT_OPENINGS,   /* inlets and outlets are what feeds those */
    FACT_PROJECTED,  /* the flow is projected, not solved at once by newton */
    FACT_PERIODIC,   /* a periodic side: each domain has, blocks name theirs */
    FACT_LEVEL,      /* a height of p = 0 that is not that of the surface of the shapes */
    FACT_STILL,      /* a hydrostatic pressure that shows */
    FACT_WEIGHT,     /* gravity that drives a flow or a surface, or shows in the pressure */
    FACT_INFLOW,     /* an inflow that has the velocity of the start */
    FACT_PICTURES,   /* snapshots */
    FACT_SPACE,      /* three dimensions */
    FACTS_OF_PROGRAM /* the first one of a program's own */
};

/* The facts in the manual's words: WORDS_X is what a key that needs FACT_X is "used with". */
#define WORDS_SPH "sph"
#define WORDS_FV "fv"
#define WORDS_SPH_ALONE "sph alone"
#define WORDS_COUPLED "a coupled job"
#define WORDS_SURFACE "a free surface"
#define WORDS_FULL "fv, or no free surface"
#define WORDS_FRICTION "fluid.nu, or fv"
#define WORDS_VISCOUS "fluid.nu"
#define WORDS_ZONES "open sides of sph.box"
#define WORDS_OPENINGS "no sph.box (or sph.outer = sides)"
#define WORDS_PROJECTED "fv.integrator other than newton"
#define WORDS_PERIODIC "fv.cells, or a side of a block that is periodic"
#define WORDS_LEVEL "fv: no shapes, or an outflow"
#define WORDS_STILL "weight across closed sides, or a wave"
#define WORDS_WEIGHT "a free surface, a periodic axis, or pressure that shows"
#define WORDS_INFLOW "an inflow of a block without a velocity"
#define WORDS_PICTURES "output.snapshots"
#define WORDS_SPACE "domain.dim = 3"

/* What a scene says by itself, and all that a program judges. */
unsigned long long scene_facts(const struct scene *s, const struct params *p);
/* Keys of the scene that a run with these facts does not use; scene_check asks the conditions
 * without facts. */
void scene_check_facts(const struct scene *s, const struct params *p, unsigned long long facts,
                       struct faults *f);
/* Whether output.fields asks for this field of a snapshot: a list of words, with blanks or commas
 * between them. */
bool scene_shows(const struct scene *s, const char *field);
/* A fault for each word of output.fields that is none of `known', a list like it: the fields that
 * `program' has. */
void scene_check_shown(const struct scene *s, const struct params *p, const char *program,
                       const char *known, struct faults *f);
