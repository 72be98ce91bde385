/* body_check.h - faults in the keys of bodies that need more than one key.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_CHECK_H
#define SPH_BODY_CHECK_H

#include "../sph.h"

/* Adds faults for motion that jumps, masses that no body has, degrees of freedom locked in vain,
 * and lines that a step cannot follow. Call on all ranks alike. */
void body_check(const struct run *r, const struct sph_params *used, struct faults *f);
/* Logs where prescribed motion begins elsewhere than in the body's place, and warns of what a run
 * will not see and of steps much shorter than dt, s, those of the fluid. Returns the largest step
 * that all bodies allow, s. */
double bodies_describe(const struct run *r, const struct sph_params *used, double dt);

#endif
