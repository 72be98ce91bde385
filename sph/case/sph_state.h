/* sph_state.h - the state of a run, made and freed.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_STATE_H
#define SPH_STATE_H

#include "../sph.h"

/* prm as sph_params_of gives it, copied; f: restart file, then r->t and r->step are set, or NULL.
 * NULL: f does not fit. Collective over r->comm. */
struct sph *sph_create(struct run *r, const struct sph_params *prm, struct h5 *f);
void sph_free(struct sph **s);

#endif
