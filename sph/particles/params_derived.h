/* params_derived.h - what follows from parameters as the run uses them and the scene: the region of
 * the particles and its sides, bounds of the step. Nothing here reads a file.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PARAMS_DERIVED_H
#define SPH_PARAMS_DERIVED_H

#include "../sph.h"

static inline bool sph_params_is_wall(const struct scene_wall *w)
{
    return w->kind == WALL_SLIP || w->kind == WALL_NO_SLIP;
}

static inline bool sph_params_is_riemann(int scheme)
{
    return scheme == SCHEME_RIEMANN_ALE || scheme == SCHEME_RIEMANN;
}

/* Region of the particles and which of its axes are periodic. */
void sph_params_region(const struct scene_domain *d, const struct sph_params *prm, double lo[3],
                       double hi[3], bool periodic[3]);
/* Whether a side (2a: low, 2a + 1: high) of the region lies on the domain's. */
bool sph_params_reaches(const struct scene_domain *d, const struct sph_params *prm, int side);
/* Whether the case has transition and buffer zones. */
bool sph_params_zones(const struct run *r, const struct sph_params *prm);
/* Whether particles can meet walls: polylines, bodies, sides of the domain that the region reaches.
 */
bool sph_params_walls(const struct scene *c, const struct sph_params *prm);
/* Sides of the region where the flow outside is known: neither periodic nor walls; none without
 * sph.outer. */
void sph_params_open(const struct run *r, const struct sph_params *prm, bool open[6]);
/* What the acoustic damper leaves of the step of a Riemann scheme, - */
double sph_params_damped_share(const struct sph_params *prm);
/* Largest stable CFL number of the scheme, measured. */
double sph_params_cfl_bound(const struct sph_params *prm, int dim);
/* Largest step [2.102-2.104] for signals of this speed, m/s; limited_by: NULL or gets "sound" or
 * "viscosity". */
double sph_params_dt(const struct sph_params *prm, double nu, double signal,
                     const char **limited_by);

#endif
