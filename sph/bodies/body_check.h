/* body_check.h - what is wrong with the keys of bodies. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_CHECK_H
#define SPH_BODY_CHECK_H

#include "../sph.h"

/* Motion that jumps, masses that no body has, degrees locked in vain, lines that a step cannot
 * follow. */
void body_check(const struct run *r, const struct sph_params *used, struct faults *f);
/* Largest speed of a body that its motion and its fall let expect, m/s. */
double body_speeds(const struct scene *c, struct motion_files *files);

#endif
