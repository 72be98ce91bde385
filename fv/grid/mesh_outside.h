/* mesh_outside.h - what stands outside the outflows that blocks declare themselves (blocks.i_max =
 * "outflow") under a free surface: water as high as that in them at the start, or nothing. For
 * walls on the sides of the domain scene_openings.h does the same.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "mesh.h"

enum { MESH_OUTSIDES = 7 }; /* by mesh_block.on: sides of the domain, and all sides within it */

/* The outside of the outflows on one side of the domain. */
struct mesh_outside {
    bool any;      /* a block has an outflow of its own there */
    bool falls;    /* nothing stands in any of them */
    bool lower;    /* less than elsewhere */
    double stands; /* m: the highest water in them; NAN: not known */
};

/* Sets all of them from the water at the start; every rank finds the same. */
void mesh_outside_find(const struct run *r, const struct mesh *m,
                       struct mesh_outside of[MESH_OUTSIDES]);
/* Logs them. */
void mesh_outside_describe(const struct run *r, const struct mesh *m);
