/* sph_bodies.h - the door of this folder, the one header of it that others include: free bodies
 * in the flow, their contacts and checks. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODIES_DOOR_H
#define SPH_BODIES_DOOR_H

#include "bodies.h"
#include "body_backs.h"
#include "body_check.h"
#include "body_courses.h"
#include "body_pace.h"
#include "paddles.h"
#include "shut_water.h"

#endif
