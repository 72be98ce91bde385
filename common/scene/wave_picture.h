/* wave_picture.h - the waves of a case alone, without a run (--check=waves): what they are in the
 * log, and an SVG of their level, their spectrum or the fastest velocities over depth.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_PICTURE_H
#define COMMON_WAVE_PICTURE_H

#include "scene.h"

/* Of a scene that has the group waves. */
void wave_picture(const char *path, const struct scene *s);

#endif
