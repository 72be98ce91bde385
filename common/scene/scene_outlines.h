/* scene_outlines.h - points of walls, bodies and shapes from files (key outline).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_OUTLINES_H
#define COMMON_SCENE_OUTLINES_H

#include "scene.h"

/* Reads the files, which stand beside the case in dir, scales, turns and shifts their corners, and
 * makes them the points; faults of the files. Before scene_check. */
void scene_outlines_read(struct scene *s, const char *dir, const struct params *p,
                         struct faults *f);

#endif
