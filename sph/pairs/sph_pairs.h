/* sph_pairs.h - the door of this folder, the one header of it that others include: lists of
 * neighbours, the kernel, the schemes and their sums. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PAIRS_DOOR_H
#define SPH_PAIRS_DOOR_H

#include "collisions.h"
#include "eigenvalue.h"
#include "kernel.h"
#include "kernel_sums.h"
#include "neighbours.h"
#include "scheme.h"
#include "vec.h"

#endif
