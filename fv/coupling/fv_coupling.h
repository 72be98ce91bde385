/* fv_coupling.h - the door of this folder, the one header of it that others include: exchange
 * with the coupler. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_COUPLING_DOOR_H
#define FV_COUPLING_DOOR_H

#include "fv_link.h"
#include "water_budget.h"

#endif
