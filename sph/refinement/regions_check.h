/* regions_check.h - what no refinement can make of the keys of group apr, and what it will cost.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_REGIONS_CHECK_H
#define SPH_REGIONS_CHECK_H

#include "../sph.h"

struct picture;

/* used: sph_params_of. Collective. */
void regions_check(const struct run *r, const struct sph_params *used, struct faults *f);
/* Whether apr.particles leaves criteria anything beyond the n particles that are there anyhow. */
void regions_check_budget(const struct run *r, double n, struct faults *f);
/* regions_describe.c: lines of --check: levels, dx, about how many particles of each. */
void regions_describe(const struct run *r, const struct sph_params *used);
/* About how many particles fixed regions have at the start, of all levels above 0; those that
 * criteria may add are not known. 0 without refinement. */
double regions_particles(const struct run *r, const struct sph_params *used);
/* m: spacing of the finest level. */
double regions_finest(const struct run *r, const struct sph_params *used);
/* Edges of the regions at the start. Rank 0. */
void regions_draw(const struct run *r, const struct sph_params *used, struct picture *p);

#endif
