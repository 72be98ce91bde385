/* sph_particles.h - the door of this folder, the one header of it that others include: arrays
 * and records of particles, equation of state, sums over them, sides that fluid passes.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "eos.h"
#include "params_derived.h"
#include "region_sides.h"
#include "state_sums.h"
#include "volume.h"
