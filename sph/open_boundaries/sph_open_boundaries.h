/* sph_open_boundaries.h - the door of this folder, the one header of it that others include:
 * inlets, outlets, wave sides, boxes in an outer flow. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_OPEN_BOUNDARIES_DOOR_H
#define SPH_OPEN_BOUNDARIES_DOOR_H

#include "box_motion.h"
#include "box_tracking.h"
#include "level_gap.h"
#include "openings.h"
#include "outer_lattice.h"
#include "sides.h"
#include "wave_outside.h"
#include "wave_stream.h"
#include "wet_faces.h"
#include "zone_steps.h"
#include "zone_volumes.h"
#include "zones.h"

#endif
