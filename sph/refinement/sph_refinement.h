/* sph_refinement.h - the door of this folder, the one header of it that others include: levels
 * of refinement, their guards and criteria. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_REFINEMENT_DOOR_H
#define SPH_REFINEMENT_DOOR_H

#include "apr_params.h"
#include "counts.h"
#include "criteria.h"
#include "guards.h"
#include "mixed.h"
#include "refinement.h"
#include "regions_check.h"

#endif
