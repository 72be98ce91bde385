/* sph_params.h - the parameters of groups sph and apr: tables, faults between keys, defaults
 * that follow from others. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SPH_PARAMS_H
#define SPH_SPH_PARAMS_H

#include "../common/scene/scene_speed.h"
#include "sph.h"

enum { SPH_GROUPS = 2 };
extern const struct param_group sph_groups[SPH_GROUPS];

/* As the run uses them: c0, cfl_viscous, box and outer filled in where the case leaves them open.
 * Borrowed until the end of the program. */
const struct sph_params *sph_params_of(const struct run *r);
/* What the scene lets expect of its velocities, motion files of bodies included. */
struct scene_speed sph_params_speed(const struct run *r);
/* Region of the particles and which of its axes are periodic. */
void sph_params_region(const struct scene_domain *d, const struct sph_params *prm, double lo[3],
                       double hi[3], bool periodic[3]);
/* The outer box along axis a around a free zone, m: transition and buffer on either side, and what
 * makes it whole particles. */
void sph_params_around(const struct run *r, const struct sph_params *prm, int a, double free[2][3],
                       double *from, double *to);
/* Whether a side (2a: low, 2a + 1: high) of the region lies on the domain's. */
bool sph_params_reaches(const struct scene_domain *d, const struct sph_params *prm, int side);
/* Whether the case has transition and buffer zones. */
bool sph_params_zones(const struct run *r);
bool sph_params_walls(const struct run *r); /* walls or bodies */
/* Sides of the region where the flow outside is known: neither periodic nor walls; none without
 * sph.outer. */
void sph_params_open(const struct run *r, const struct sph_params *prm, bool open[6]);
void sph_params_check(const struct run *r, struct faults *f);
/* Largest stable CFL number of the scheme, measured. */
double sph_params_cfl_bound(const struct sph_params *prm, int dim);
/* Of dt nu/R^2. */
double sph_params_viscous_bound(const struct run *r, const struct sph_params *prm);
/* Largest step [2.102-2.104] for signals of this speed, m/s; limited_by: NULL or gets "sound" or
 * "viscosity". */
double sph_params_dt(const struct sph_params *prm, double nu, double signal,
                     const char **limited_by);

#endif
