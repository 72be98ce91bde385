/* wall_gaps.h - first particles of finer levels in the gaps that coarser ones leave at walls.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

struct sph;

/* For a finer level after its creation, in 2D: adds particles where walls have kept its parents
 * out, as in wedges. Their slopes are 0, their roles are still to be given. Collective. */
void wall_gaps_fill(struct sph *s);
