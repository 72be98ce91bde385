/* surface_blocks.h - blocks and water of the tests of a free surface on them.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "mesh_case.h"

#define SLIP_I "i_min = \"slip\"; i_max = \"slip\"; "
#define SLIP_J "j_min = \"slip\"; j_max = \"slip\"; "
#define HEAVY "fluid.gravity=(0,-9.81)"

static const char joined[] =
    "{ name = \"l\"; cells = (10, 14); max = (0.5, 0.7); i_max = \"joined\"; i_min = "
    "\"slip\"; " SLIP_J
    "}, { name = \"r\"; cells = (10, 14); min = (0.5, 0.0); max = (1.0, 0.7); i_min = \"joined\"; "
    "i_max = \"slip\"; " SLIP_J "}";
static const char turned[] =
    "{ name = \"back\"; cells = (30, 21); max = (1.0, 0.7); " SLIP_I SLIP_J
    "}, { name = \"turned\"; cells = (14, 14); min = (0.3, 0.15); max = (0.7, 0.55); angle = 30.0; "
    "centre = (0.5, 0.35); }";
static const char canal[] = "{ name = \"v\"; cells = (32, 32); max = (1.2, 1.2); angle = 45.0; "
                            "centre = (0.0, 0.0); " SLIP_I SLIP_J "}";
static const char halves[] =
    "{ name = \"l\"; cells = (20, 24); max = (1.0, 1.0); i_max = \"joined\"; "
    "}, { name = \"r\"; cells = (20, 24); min = (1.0, 0.0); max = (2.0, "
    "1.0); i_min = \"joined\"; }";
static const char stretched[] =
    "{ name = \"one\"; mapping = \"stretched\"; stretch = (0.5, 0.5); focus = (1.0, 0.5); cells = "
    "(40, 24); max = (2.0, 1.0); }";
/* Water to the left of the middle, for what ranks and restarts must agree on. */
static const struct scene_shape column = {.form = SHAPE_BOX, .box = {{-1.0, -1.0}, {0.35, 0.45}}};

/* Starts the blocks with this water beside that of the scene (NULL: none). */
static inline struct fv *start_blocks(struct mesh_case *c, MPI_Comm comm, const char *blocks,
                                      const char *const *overrides, const struct scene_shape *water)
{
    mesh_case_read(c, comm, blocks, overrides);
    if (water)
        c->run.scene.shapes[c->run.scene.nshapes++] = *water;
    return mesh_case_create(c, NULL);
}
