/* fv_time.h - the door of this folder, the one header of it that others include: time steps:
 * stages, the integrators, moving grids. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_TIME_DOOR_H
#define FV_TIME_DOOR_H

#include "moving.h"
#include "newton.h"
#include "stages.h"
#include "steps.h"
#include "surface_steps.h"

#endif
