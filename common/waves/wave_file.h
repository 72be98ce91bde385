/* wave_file.h - what the group waves takes from a file of waves (swd.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_FILE_H
#define COMMON_WAVE_FILE_H

#include "swd.h"
#include "waves.h"

/* Of the level at the first time, by |k|: linear waves towards +x; their number in n; owned by the
 * caller. */
struct wave_component *wave_file_components(struct swd *s, double g, double depth, int *n);
/* Significant height and mean length, m, of a file over `depth' m of water that is asked for from
 * the file's time t0 to t1, s. false: it does not do; why in error. */
bool wave_file_probe(const char *path, double depth, double t0, double t1, double *height,
                     double *length, char *error, size_t size);

#endif
