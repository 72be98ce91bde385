/* sph_facts.h - what keys of the groups sph and apr may need of a run, beside the facts of a scene.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_FACTS_H
#define SPH_FACTS_H

#include "../common/scene/scene.h"

/* Facts behind those of enum scene_fact; WORDS_X below says what a run with FACT_X has. */
enum sph_fact {
    FACT_RIEMANN = FACTS_OF_PROGRAM,
    FACT_ONE_SIZE,
    FACT_SHIFT_ENDS,
    FACT_SHIFTED,
    FACT_BOUNDED,
    FACT_FLOORED, /* sph.dissipation above 0 */
    FACT_ARTIFICIAL,
    FACT_DIFFUSIVE,
    FACT_NO_SURFACE,
    FACT_WALLS, /* walls or bodies that particles meet */
    FACT_FLUXES,
    FACT_PACKED, /* the first places are rearranged */
    FACT_PLANE,
    FACT_OUTER /* open sides that the case leaves to sph.outer */
};

#define WORDS_RIEMANN "a Riemann scheme"
#define WORDS_ONE_SIZE "a Riemann scheme and particles of one size (apr.method = guards)"
#define WORDS_SHIFT_ENDS "a free surface, transport = tvs or tvo and apr.method = guards"
#define WORDS_SHIFTED "sph.transport = tvs or tvo"
#define WORDS_BOUNDED "a Riemann scheme with low_dissipation"
#define WORDS_FLOORED "a least share of low_dissipation above 0"
#define WORDS_ARTIFICIAL "scheme = delta or standard"
#define WORDS_DIFFUSIVE "scheme = delta"
#define WORDS_NO_SURFACE "no free surface"
#define WORDS_WALLS "walls or bodies"
#define WORDS_FLUXES "normal flux walls"
#define WORDS_PACKED "walls, bodies or noise"
#define WORDS_PLANE "domain.dim = 2"
#define WORDS_OUTER "open sides, or inlets and outlets"

#endif
