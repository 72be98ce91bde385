/* sph_sense.h - faults and warnings of scenes that are valid by themselves, but which particles
 * cannot represent. given: the parameters as the case has them; used: the result of sph_params_of.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../particles/sph_particles.h"

/* Particles across a passage below which more than 10 % of a flow are missing; but for the last
 * digits of a width. */
#define SPH_PASSAGE (10.0 * (1.0 - 1e-6))

/* Warns that between what `where' names, `width', m, apart, a part of the flow is missing: water
 * leaves a tank through a slot of n particles, a plate as thick as it is wide, with 0.32, 0.66,
 * 0.84, 0.94, 0.97 of the discharge at n = 4, 6, 8, 12, 16, so that about 10/n^2 is missing. */
void sph_passage_warn(const char *where, double width, double dx);
/* Adds faults for open sides, boxes, gauges and gravity that contradict each other. */
void sph_sense_check(const struct run *r, const struct sph_params *given,
                     const struct sph_params *used, struct faults *f);
/* sph_meshes.c: adds faults for surfaces of triangles that this spacing cannot represent. */
void sph_meshes_check(const struct run *r, const struct sph_params *used, struct faults *f);
/* Warns of those that it represents badly. Collective. */
void sph_meshes_warn(const struct run *r, const struct sph_params *used);
/* sph_falls.c: warns if nothing in the scene catches water that falls. */
void sph_falls_warn(const struct run *r, const struct sph_params *used);
/* Whether lines and surfaces of walls and bodies stand in the way of the displacement d, m, from
 * x. */
bool sph_falls_stopped(const struct scene *c, const double *x, const double *d);
/* sph_body_paths.c, 2D: adds faults for motion files, and for bodies that leave the domain or meet
 * walls and each other. */
void sph_bodies_check(const struct run *r, const struct sph_params *used, struct faults *f);
