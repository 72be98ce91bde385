/* sph_unused.h - keys that a run of particles would pass over.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SPH_UNUSED_H
#define SPH_SPH_UNUSED_H

#include "../particles/params_derived.h"

/* given: as the case has it; used: sph_params_of. */
void sph_unused_check(const struct run *r, const struct sph_params *given,
                      const struct sph_params *used, struct faults *f);

#endif
