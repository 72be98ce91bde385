/* scene_check.h - the parts of scene_check (scene.h), which add faults to f. Call on all ranks
 * alike.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

/* Faults of a motion that is not a body's, list.[k].motion in the case: it makes no waves. */
void scene_check_motion(const struct scene_motions *all, const char *list, int k,
                        const struct params *p, struct faults *f);
/* Keys that contradict each other, and places outside the domain; in scene_sense.c. */
void scene_check_sense(const struct scene *s, const struct params *p, struct faults *f);
