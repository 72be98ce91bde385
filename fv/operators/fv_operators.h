/* fv_operators.h - the door of this folder, the one header of it that others include: discrete
 * operators of every kind of cells, and measures of the flow.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OPERATORS_DOOR_H
#define FV_OPERATORS_DOOR_H

#include "blocked_cells.h"
#include "flow_measures.h"
#include "flow_ops.h"
#include "helmholtz.h"
#include "mesh_ops.h"
#include "operators.h"
#include "viscous_solver.h"

#endif
