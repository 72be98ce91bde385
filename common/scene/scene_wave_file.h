/* scene_wave_file.h - the file of waves of a case. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_WAVE_FILE_H
#define COMMON_SCENE_WAVE_FILE_H

#include "scene.h"

/* Of waves of kind file: finds it, beside the case in dir, and their height and length; faults.
 * Before scene_check. */
void scene_wave_file_read(struct scene *s, const char *dir, const struct params *p,
                          struct faults *f);

#endif
