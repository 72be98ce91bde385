/* sph_surface.h - the door of this folder, the one header of it that others include: free
 * surface: its detection, gauges of level, feedback of the volumes.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "level_gauge.h"
#include "level_window.h"
#include "rest_excess.h"
#include "surface.h"
#include "volume_feedback.h"
