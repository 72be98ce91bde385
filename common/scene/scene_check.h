/* scene_check.h - the parts of scene_check. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_CHECK_H
#define COMMON_SCENE_CHECK_H

#include "scene.h"

/* scene_unused.c: keys that other keys leave without use. */
void scene_check_unused(const struct scene *s, const struct params *p, struct faults *f);
/* The same of the terms of a motion, of list.[k].motion. */
void scene_check_motion(const struct scene_motions *all, const char *list, int k,
                        const struct params *p, struct faults *f);
/* scene_sense.c: keys that contradict each other, and places outside the domain. */
void scene_check_sense(const struct scene *s, const struct params *p, struct faults *f);

#endif
