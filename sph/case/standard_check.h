/* standard_check.h - where scheme standard holds beside normal flux walls [4.22-4.25].
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/run/run.h"
#include "../sph_parameters.h"

/* Of particles that meet walls: refuses the scheme elsewhere, with the reason. */
void standard_check(const struct run *r, const struct sph_params *used, struct faults *f);
