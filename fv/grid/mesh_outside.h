/* mesh_outside.h - what stands outside the outflows that blocks give themselves (blocks.i_max =
 * "outflow") under a free surface: as high as the water in them at the start, or nothing; what
 * walls do for the sides of the domain, scene_openings.h does.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_OUTSIDE_H
#define FV_MESH_OUTSIDE_H

#include "mesh.h"

enum { MESH_OUTSIDES = 7 }; /* by mesh_block.on: sides of the domain, and all sides within it */

struct mesh_outside {
    bool any;      /* a block has an outflow of its own there */
    bool falls;    /* nothing stands in any of them */
    bool lower;    /* less than elsewhere */
    double stands; /* m: the highest water in them; NAN: not known */
};

void mesh_outside_find(const struct run *r, const struct mesh *m,
                       struct mesh_outside of[MESH_OUTSIDES]);
/* In the log. */
void mesh_outside_describe(const struct run *r, const struct mesh *m);

#endif
