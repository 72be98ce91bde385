/* fv_facts.h - what keys of the groups fv and blocks may need of a run, beside the facts of a
 * scene, and the tests of their conditions, in fv_unused.c. SPDX-License-Identifier: BSD-3-Clause
 */
#pragma once

#include "../../common/scene/scene.h"

enum fv_fact {
    FACT_UNIFORM = FACTS_OF_PROGRAM, /* cells of one grid, no blocks */
    FACT_FORCES                      /* forces on walls of blocks */
};

#define WORDS_UNIFORM "no blocks"
#define WORDS_FORCES "a side of a block that is a wall"

/* Conditions of a row (params_use.h): `p' is the struct fv_params, `block' a mesh_block_params.
 * fv.graded: it gives a number of equal layers, so that those below them grow. */
bool fv_has_layers(const void *run, const void *p);
/* fv.extrema: the first of the reference's three is given. */
bool fv_has_extrema(const void *run, const void *p);
/* fv.hole: some cell lies wholly in the box, so that cells are imposed at all. */
bool fv_has_hole(const void *run, const void *p);
/* blocks.centre: something turns about it, an angle, a ring, or walls whose moment is taken there.
 */
bool mesh_turns(const void *run, const void *block);
/* blocks.focus: the mapping is stretched, along some index. */
bool mesh_has_focus(const void *run, const void *block);
/* blocks.stretch: a ring is stretched outwards alone, by the first number. */
bool mesh_stretch_fits(const void *run, const void *block);
/* blocks.zone: the file of the vertices is Plot3D's, which has zones; HDF5 has none. */
bool mesh_has_zones(const void *run, const void *block);
/* blocks.velocity: a side is a wall or an inflow. */
bool mesh_has_moving_side(const void *run, const void *block);
/* blocks.friction: a side is slip. */
bool mesh_has_bed(const void *run, const void *block);
/* blocks.spin: each number belongs to a wall, of i_min or i_max. */
bool mesh_spin_fits(const void *run, const void *block);
