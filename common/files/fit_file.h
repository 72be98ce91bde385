/* fit_file.h - samples of an oscillation in restart files, so that a run that goes on fits all of
 * them. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../base/base.h"
#include "h5.h"

/* Writes the samples, which are the same on all ranks, as the dataset "signal" (none: nothing), or
 * adds those of the file, if it has any, on all ranks; they belong to `owner'. Collective. */
void fit_restart(void *owner, struct fit *samples, struct h5 *f);
