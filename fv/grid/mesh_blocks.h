/* mesh_blocks.h - the blocks as the case has them: plain data that case/ writes and hands down.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/run/run.h"
#include "../../common/scene/scene.h"
#include "side_kinds.h"

/* Most blocks of a case. */
enum { MESH_BLOCKS_MAX = 16 };
/* blocks.mapping, how the vertices of a block follow from its keys; FILE: they are read. */
enum mesh_mapping {
    MAPPING_BOX,
    MAPPING_STRETCHED,
    MAPPING_ANNULUS,
    MAPPING_SHEARED,
    MAPPING_FILE
};

/* The keys of one block. */
struct mesh_block_params {
    char name[PARAM_TEXT_SIZE];
    int mapping;           /* enum mesh_mapping */
    int cells[3];          /* along its indices */
    double min[3], max[3]; /* m: of a box before its rotation; z of an annulus */
    double centre[3];      /* m: of rotation, of an annulus, of the walls' spin */
    double angle;          /* degrees about z */
    double focus[3];       /* m: where the cells of a stretched block are finest */
    double stretch[3];     /* strength; 0: uniform; < 0: finer towards both ends */
    double radius[3];      /* m: inner, outer */
    double arc[3];         /* degrees: first, last */
    double shear;          /* dx/dy */
    double wave;           /* amplitude of a wavy displacement over the sides' lengths */
    char file[PARAM_TEXT_SIZE];
    int zone;                                     /* block of a file, from 1 */
    int i_min, i_max, j_min, j_max, k_min, k_max; /* enum mesh_side */
    double velocity[3];                           /* m/s: of walls along themselves, of an inflow */
    double friction;                              /* bed friction c_f of slip sides */
    int lid;        /* 0: all walls have the velocity; else the side that alone has it, from 1 */
    double spin[3]; /* rad/s: of the walls i_min, i_max about the centre */
    struct scene_motions motion; /* of the whole block, see mesh_motion.h */
    int number;                  /* in the list of the case, from 0 */
};

/* The list of a case; n 0: it has none, but uniform cells. */
struct mesh_blocks {
    int n;
    const struct mesh_block_params *of; /* borrowed from case/ for the whole run */
};

/* Whether one of the block's own sides is of this kind, walls of the domain's sides left out. */
bool mesh_block_has(const struct mesh_block_params *b, enum mesh_side kind);
/* Whether the forces on a side of the block count as those on its body: on a no-slip wall, and on a
 * slip side that does not lie on a side of the domain. mesh_block_is_body: whether any side
 * does. */
bool mesh_side_is_body(const struct run *r, const struct mesh_block_params *b, int side);
bool mesh_block_is_body(const struct run *r, const struct mesh_block_params *b);
/* Whether one of the blocks has a motion of its own. */
bool mesh_blocks_move(const struct mesh_blocks *all);
/* Adds a fault at the block's key. */
void mesh_fault(const struct run *r, struct faults *f, const struct mesh_block_params *b,
                const char *key, const char *fmt, ...) __attribute__((format(printf, 5, 6)));
