/* body_boxes.h - bodies at rest that are boxes along the axes: cells are cut out for them.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../boundary/fv_boundary.h"

struct run;

/* The box that body k of the scene is; NULL, or why it is none: text that lasts. */
const char *body_box(const struct run *r, int k, struct blocked_params *box);
/* Appends those of all bodies to box[n]; returns how many there are then, BLOCKED_MAX at most. None
 * in a coupled job, where the particles' program has the bodies, nor with blocks. */
int body_boxes(const struct run *r, struct blocked_params *box, int n);
