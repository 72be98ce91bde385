/* wave_file.h - what the group waves takes from a file of waves (swd.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_FILE_H
#define COMMON_WAVE_FILE_H

#include "imposed_waves.h"
#include "swd.h"

/* The level at the first time as linear waves towards +x, by |k|; *n of them, owned by the caller
 * (mem_free). */
struct wave_component *wave_file_components(struct swd *s, double g, double depth, int *n);
/* Significant height and mean length, m, of a file over water of `depth', m, of which the times t0
 * to t1, s, will be needed. false: the file does not fit; error[size] says why. */
bool wave_file_probe(const char *path, double depth, double t0, double t1, double *height,
                     double *length, char *error, size_t size);

#endif
