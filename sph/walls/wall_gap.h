/* wall_gap.h - what faces of different owners (bodies, walls at rest) within one support owe each
 * other. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_GAP_H
#define SPH_WALL_GAP_H

#include "wall_list.h"

/* Touches of one particle that are asked at most; beyond, those with the largest weight. */
enum { GAP_FACES = 12 };

/* Whether the k-th particle of the list meets faces of more than one owner. */
bool wall_gap_between(const struct wall_list *l, int k);
/* Credits the forces that these faces exchange, with the momentum fluxes q[dim] of its touches,
 * N/m^dim, counted from first[k], and its volume w, m^dim. Their sum is zero. */
void wall_gap_exchange(const struct sph *s, struct wall_list *l, int k, const double (*q)[3],
                       double w);

#endif
