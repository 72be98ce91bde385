/* scene_wave_file.c - see scene_wave_file.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_wave_file.h"

#include "../waves/waves.h"
#include "scene_waves.h"
#include "wave_maker.h"

void scene_wave_file_read(struct scene *s, const char *dir, const struct params *p,
                          struct faults *f)
{
    struct scene_waves *w = &s->waves;
    char error[900];
    const double depth = scene_waves_depth(s);
    if (!s->has_waves || w->kind != WAVE_FILE || !(depth > 0.0))
        return; /* without a depth scene_waves_check asks for it */
    snprintf(w->path, sizeof w->path, "%s", case_path(dir, w->file));
    if (!*w->file)
        params_fault(p, f, "waves.kind", "which file? give its name as waves.file");
    else if (scene_has_wave_maker(s))
        params_fault(p, f, "waves.kind",
                     "a paddle makes no waves of a file: sides of kind wave do");
    else if (!wave_file_probe(w->path, depth, -w->at[1], s->time.end - w->at[1], &w->height,
                              &w->length, error, sizeof error))
        params_fault(p, f, "waves.file", "%s", error);
}
