/* sph_params.h - the parameters of groups sph and apr: tables, faults between keys, defaults that
 * follow from other keys.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../particles/sph_particles.h"

/* The groups sph and apr of a case, for struct program. */
enum { SPH_GROUPS = 2 };
extern const struct param_group sph_groups[SPH_GROUPS];

/* The parameters as the run uses them: c0, cfl_viscous, box and outer filled in where the case
 * leaves them open. Derived once at the start. Borrowed until the end of the program. */
const struct sph_params *sph_params_of(const struct run *r);
/* scene_meshes_read, with facets of round bodies as large as the particles are apart. */
void sph_meshes_read(struct scene *s, const char *case_dir, const struct params *p, MPI_Comm comm,
                     struct faults *f);
/* Adds the faults between keys. Call on all ranks alike. */
void sph_params_check(const struct run *r, struct faults *f);
