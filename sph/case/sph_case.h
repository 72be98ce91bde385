/* sph_case.h - the door of this folder, the one header of it that others include: keys of sph
 * and the state that they make. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "first_water.h"
#include "sph_params.h"
#include "sph_sense.h"
#include "sph_state.h"
