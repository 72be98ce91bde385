/* wave_field_save.h - a wave field in restart files. Both are collective over the file.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_FIELD_SAVE_H
#define COMMON_WAVE_FIELD_SAVE_H

#include "../files/h5.h"
#include "wave_field.h"

/* writes: on one rank; all hold the same. */
void wave_field_save(const struct wave_field *f, struct h5 *file, bool writes);
/* Goes on from the state of the file; without one of these waves it evolves from its start, to the
 * same bits. */
void wave_field_load(struct wave_field *f, struct h5 *file);

#endif
