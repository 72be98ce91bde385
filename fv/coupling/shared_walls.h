/* shared_walls.h - walls that a coupled job's scene draws as lines (walls.points) and FV's blocks
 * have as sides: both programs must mean the same wall. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_SHARED_WALLS_H
#define FV_SHARED_WALLS_H

#include "../fv.h"

/* In 2D, of n partners: given (lower, upper corner) is what FV takes from each, box all that each
 * computes. false: a line lies within FV's cells and is no side of theirs, or a side that a partner
 * meets is no wall of its own; why (of `size') says where. Collective. */
bool shared_walls_agree(const struct fv *s, int n, const double (*given)[2][3],
                        const double (*box)[2][3], char *why, size_t size);

#endif
