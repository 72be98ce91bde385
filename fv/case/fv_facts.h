/* fv_facts.h - what keys of the groups fv and blocks may need of a run, beside the facts of a
 * scene, and the tests of their conditions, in fv_unused.c. SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef FV_FACTS_H
#define FV_FACTS_H

#include "../../common/scene/scene.h"

enum fv_fact {
    FACT_UNIFORM = FACTS_OF_PROGRAM, /* cells of one grid, no blocks */
    FACT_FORCES                      /* forces on walls of blocks */
};

#define WORDS_UNIFORM "no blocks"
#define WORDS_FORCES "a side of a block that is a wall"

/* Conditions of a row (params_use.h): `p' is the struct fv_params, `block' a mesh_block_params. */
bool fv_has_layers(const void *run, const void *p);
bool fv_has_extrema(const void *run, const void *p);
bool fv_has_hole(const void *run, const void *p);
bool mesh_turns(const void *run, const void *block);
bool mesh_has_focus(const void *run, const void *block);
bool mesh_stretch_fits(const void *run, const void *block);
bool mesh_has_zones(const void *run, const void *block);
bool mesh_has_moving_side(const void *run, const void *block);
bool mesh_spin_fits(const void *run, const void *block);

#endif
