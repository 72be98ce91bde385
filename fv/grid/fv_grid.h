/* fv_grid.h - the door of this folder, the one header of it that others include: cells: parts,
 * blocks, layers, motion, overlaps. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "block.h"
#include "block_walls.h"
#include "grid.h"
#include "layout.h"
#include "mesh.h"
#include "mesh_blocks.h"
#include "mesh_motion.h"
#include "mesh_outside.h"
#include "overset.h"
#include "rows.h"
#include "side_kinds.h"
