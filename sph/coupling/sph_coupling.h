/* sph_coupling.h - the door of this folder, the one header of it that others include: exchange
 * with the coupler. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_COUPLING_DOOR_H
#define SPH_COUPLING_DOOR_H

#include "body_coupling.h"
#include "overlap.h"
#include "sph_link.h"
#include "windows.h"

#endif
