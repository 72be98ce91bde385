/* fv_surface.h - the door of this folder, the one header of it that others include: the free
 * surface: level set, fractions of water, reinitialisation, extension.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_SURFACE_DOOR_H
#define FV_SURFACE_DOOR_H

#include "fraction.h"
#include "held_inflow.h"
#include "level_ops.h"
#include "levelset.h"
#include "mesh_view.h"
#include "near_water.h"
#include "reinit_band.h"
#include "surface_forced.h"

#endif
