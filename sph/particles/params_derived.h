/* params_derived.h - what follows from the parameters and the scene: the region of the particles
 * and its sides, bounds of the time step. Pure functions that read no file.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* Whether a wall of the scene acts on particles as a wall, i.e. is no opening and no outfall. */
static inline bool sph_params_is_wall(const struct scene_wall *w)
{
    return w->kind == WALL_SLIP || w->kind == WALL_NO_SLIP;
}

/* Whether a scheme (enum sph_scheme) solves Riemann problems. */
static inline bool sph_params_is_riemann(int scheme)
{
    return scheme == SCHEME_RIEMANN_ALE || scheme == SCHEME_RIEMANN;
}

/* Sets the region of the particles, m, and which of its axes are periodic: those of the domain that
 * the region spans. */
void sph_params_region(const struct scene_domain *d, const struct sph_params *prm, double lo[3],
                       double hi[3], bool periodic[3]);
/* Whether a side (2a: low, 2a + 1: high) of the region lies on the domain's; of a periodic axis
 * whether the region spans it. */
bool sph_params_reaches(const struct scene_domain *d, const struct sph_params *prm, int side);
/* Whether some side of the region is open, so that there are transition and buffer zones. */
bool sph_params_zones(const struct run *r, const struct sph_params *prm);
/* Whether particles can meet walls: polylines, bodies, sides of the domain that the region reaches.
 */
bool sph_params_walls(const struct scene *c, const struct sph_params *prm);
/* Sets for each side of the region whether it is open, i.e. the flow outside is known there:
 * neither periodic nor a wall; none without sph.outer. */
void sph_params_open(const struct run *r, const struct sph_params *prm, bool open[6]);
/* Fraction of a Riemann scheme's step that is left when the acoustic damper is on; 1 for other
 * schemes. */
double sph_params_damped_share(const struct sph_params *prm);
/* Largest stable CFL number c dt/R of the scheme, as measured. */
double sph_params_cfl_bound(const struct sph_params *prm, int dim);
/* Largest step, s [2.102-2.104]: the least of cfl R/signal and cfl_viscous R^2/nu, for signals of
 * that speed, m/s. limited_by, if not NULL, gets "sound" or "viscosity". */
double sph_params_dt(const struct sph_params *prm, double nu, double signal,
                     const char **limited_by);
