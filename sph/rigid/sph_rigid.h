/* sph_rigid.h - the door of this folder, the one header of it that others include: motion of one
 * rigid body. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_RIGID_DOOR_H
#define SPH_RIGID_DOOR_H

#include "body.h"
#include "body_impedance.h"

#endif
