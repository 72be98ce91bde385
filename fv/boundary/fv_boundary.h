/* fv_boundary.h - the door of this folder, the one header of it that others include: sides,
 * openings, imposed and blocked cells. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_BOUNDARY_DOOR_H
#define FV_BOUNDARY_DOOR_H

#include "bc.h"
#include "blocked.h"
#include "carried.h"
#include "forcing.h"
#include "fv_sides.h"
#include "levels.h"
#include "mesh_bc.h"
#include "outflow.h"
#include "outflow_budget.h"
#include "parted.h"
#include "still.h"

#endif
