/* scene_files.h - what files beside a case add to the scene, and what follows from its keys alone:
 * the same for every program of a job, before scene_check. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "motion_files.h"
#include "scene_groups.h"

/* dir: folder of the case. files takes the histories of openings and keeps them; NULL: they stay
 * unread, and wall_histories_check is not to be called. Adds faults; the first part that has some
 * is the last. On all ranks alike. */
void scene_files_read(struct scene *s, const char *dir, struct motion_files *files,
                      const struct params *p, struct faults *f);
