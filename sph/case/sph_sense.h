/* sph_sense.h - what no particles can make of a scene that is in order by itself.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SPH_SENSE_H
#define SPH_SPH_SENSE_H

#include "../particles/params_derived.h"

/* Particles across a passage below which more than 10 % of a flow are missing. */
#define SPH_PASSAGE 10.0

/* given: as the case has it; used: sph_params_of. */
void sph_sense_check(const struct run *r, const struct sph_params *given,
                     const struct sph_params *used, struct faults *f);
/* sph_meshes.c: surfaces of triangles that this spacing cannot take. */
void sph_meshes_check(const struct run *r, const struct sph_params *used, struct faults *f);
/* What it takes at a price, through log_warn. Collective. */
void sph_meshes_warn(const struct run *r, const struct sph_params *used);
/* sph_falls.c: a warning if nothing in the scene catches water that falls. */
void sph_falls_warn(const struct run *r, const struct sph_params *used);
/* sph_bodies.c: motion files, bodies that leave the domain or meet walls and each other; 2D. */
void sph_bodies_check(const struct run *r, const struct sph_params *used, struct faults *f);

#endif
