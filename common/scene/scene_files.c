/* scene_files.c - see scene_files.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_files.h"

#include "scene_openings.h"
#include "scene_outlines.h"
#include "scene_wave_file.h"

void scene_files_read(struct scene *s, const char *dir, struct motion_files *files,
                      const struct params *p, struct faults *f)
{
    wall_histories_read(s, files);
    scene_outlines_read(s, dir, p, f);
    if (f->n == 0)
        scene_wave_file_read(s, dir, p, f);
}
