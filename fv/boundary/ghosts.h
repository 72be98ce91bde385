/* ghosts.h - ghosts of cell averages behind a side, q_1, q_2, q_3 inside, w the average on the
 * side's face, along an index:
 *   given     q_0 = 4 w - (13 q_1 - 5 q_2 + q_3)/3,  q_-1 = 16 w - (70 q_1 - 32 q_2 + 7 q_3)/3,
 *             the cubic through them; the fourth-order face value is then w itself
 *   mirrored  q_0 = q_1, q_-1 = q_2, or 2 w - q_1, 2 w - q_2
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_GHOSTS_H
#define FV_GHOSTS_H

#include <stdint.h>

enum { GHOST_LAYERS = 3 };

/* q: the cell inside; in: offset one cell inwards; w: average on the side's face. */
static inline void ghosts_given(double *q, int64_t in, double w)
{
    q[-in] = 4.0 * w - (13.0 * q[0] - 5.0 * q[in] + q[2 * in]) / 3.0;
    q[-2 * in] = 16.0 * w - (70.0 * q[0] - 32.0 * q[in] + 7.0 * q[2 * in]) / 3.0;
    q[-3 * in] = q[-2 * in]; /* no stencil reads it */
}

/* sign 1, w 0: zero gradient; sign -1: antisymmetric about w. */
static inline void ghosts_mirrored(double *q, int64_t in, double sign, double w)
{
    for (int m = 0; m < GHOST_LAYERS; m++)
        q[-(m + 1) * in] = 2.0 * w + sign * q[m * in];
}

#endif
