/* sph_time.h - the door of this folder, the one header of it that others include: Runge-Kutta
 * stages, size of the step, levels in time. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_TIME_DOOR_H
#define SPH_TIME_DOOR_H

#include "integrate.h"
#include "level.h"
#include "runge_kutta.h"

#endif
