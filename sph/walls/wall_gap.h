/* wall_gap.h - corrects the forces on faces of different owners (bodies, walls at rest) that stand
 * within one support: each lacks the part of the kernel that the other cuts off. wall_gap.c has the
 * derivation.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_GAP_H
#define SPH_WALL_GAP_H

#include "wall_list.h"

/* Pieces of wall near one particle that are considered at most; beyond, those of the largest
 * weight. */
enum { GAP_FACES = 12 };

/* Whether the k-th particle of the list is near faces of more than one owner. */
bool wall_gap_between(const struct wall_list *l, int k);
/* Adds to the forces what these faces exchange, from the momentum fluxes q[dim] of the particle's
 * pieces of wall, N/m^dim, counted from first[k], and its volume w, m^dim. The sum is zero. */
void wall_gap_exchange(const struct sph *s, struct wall_list *l, int k, const double (*q)[3],
                       double w);

#endif
