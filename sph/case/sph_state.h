/* sph_state.h - makes and frees the state of a run.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* The state at t = 0, or from the restart file f, when r->t and r->step are set. prm: the result of
 * sph_params_of, copied. NULL: f does not fit, which has been logged. Owned by the caller
 * (FREE). Collective over r->comm. */
struct sph *sph_create(struct run *r, const struct sph_params *prm, struct h5 *f);
