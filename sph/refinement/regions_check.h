/* regions_check.h - faults in the keys of group apr, and an estimate of what refinement will cost.
 * used: the result of sph_params_of.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_REGIONS_CHECK_H
#define SPH_REGIONS_CHECK_H

#include "../sph.h"

struct picture;

/* Adds the faults. Collective. */
void regions_check(const struct run *r, const struct sph_params *used, struct faults *f);
/* Adds a fault if apr.particles leaves nothing for criteria beyond the n particles that exist
 * without them. */
void regions_check_budget(const struct run *r, double n, struct faults *f);
/* regions_describe.c: logs levels, dx and the approximate number of particles of each. */
void regions_describe(const struct run *r, const struct sph_params *used);
/* Approximate number of particles of all levels above 0 that fixed regions have at the start; what
 * criteria add is not known. 0 without refinement. */
double regions_particles(const struct run *r, const struct sph_params *used);
/* Spacing of the finest level, m. */
double regions_finest(const struct run *r, const struct sph_params *used);
/* Draws the edges of the regions at the start. Rank 0. */
void regions_draw(const struct run *r, const struct sph_params *used, struct picture *p);

#endif
