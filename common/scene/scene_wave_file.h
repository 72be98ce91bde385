/* scene_wave_file.h - the file of waves (waves.file, SWD) of a case.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

/* For waves of kind file: finds the file beside the case in dir, sets waves.path and the waves'
 * height and length. Faults go to f. Before scene_check; call on all ranks alike. */
void scene_wave_file_read(struct scene *s, const char *dir, const struct params *p,
                          struct faults *f);
