/* wave_field_save.h - a wave field in restart files. Both calls are collective over the file.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_FIELD_SAVE_H
#define COMMON_WAVE_FIELD_SAVE_H

#include "../files/files.h"
#include "wave_field.h"

/* Writes the state, which all ranks hold. */
void wave_field_save(const struct wave_field *f, struct h5 *file);
/* Continues from the state in the file. If the file has none, the field evolves anew from its start
 * and reaches the same bits. */
void wave_field_load(struct wave_field *f, struct h5 *file);

#endif
