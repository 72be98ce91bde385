/* scene_outlines.h - points of walls, bodies and shapes from files (key outline).
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

/* Reads the files, which stand beside the case in dir, makes their corners the points of their
 * owner and scales, rotates and shifts points; so it does with bodies of simple form
 * (scene_forms.h). Then marks bodies that are tanks. Faults go to f. Before scene_check; call on
 * all ranks alike, each reads for itself. */
void scene_outlines_read(struct scene *s, const char *dir, const struct params *p,
                         struct faults *f);

/* Scales, rotates and shifts n corners x and makes them the points of TO. */
void scene_outline_place(const struct scene_surface *is, int n, const double (*x)[2],
                         struct param_points *to);
