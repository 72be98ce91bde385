/* wave_picture.h - the waves of a case alone, without a run (--check=waves): their figures in the
 * log, and an SVG of their level, their spectrum or the largest velocities over depth.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

/* Writes the picture to `path'. The scene must have the group waves. Rank 0. */
void wave_picture(const char *path, const struct scene *s);
