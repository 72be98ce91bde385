/* sph_unused.h - finds keys that a run of particles would not use.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../particles/sph_particles.h"

/* Adds a fault for each of them. groups: the tables of sph and apr; given: the parameters as the
 * case has them; used: the result of sph_params_of. Call on all ranks alike. */
void sph_unused_check(const struct run *r, const struct param_group groups[2],
                      const struct sph_params *given, const struct sph_params *used,
                      struct faults *f);
