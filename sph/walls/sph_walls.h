/* sph_walls.h - the door of this folder, the one header of it that others include: walls and
 * their treatments. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALLS_DOOR_H
#define SPH_WALLS_DOOR_H

#include "forces.h"
#include "wall_cover.h"
#include "wall_ends.h"
#include "wall_joint.h"
#include "wall_share.h"
#include "wall_thin.h"
#include "walls.h"

#endif
