/* scheme.h - what a pair interaction provides. Both passes run over the list of s->list with prim (and
 * slope) of locals and ghosts; 2D and 3D, with and without viscosity are constants of one body.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SCHEME_H
#define SPH_SCHEME_H

#include "sph.h"

struct scheme {
    const char *name;
    /* First pass (one-sided): renormalised gradients of rho and u and the transport velocity of every local
     * particle into slope; zero slope where M is nearly singular (smallest eigenvalue < 0.2).
     * u0 = u + shift, limited. */
    void (*gradients)(struct sph *s);
    /* Second pass (symmetric): p.rate of every local particle from prim and slope. */
    void (*rates)(struct sph *s);
};

/* The scheme that the parameters name; picks the instances for dim, viscosity, limiter. */
const struct scheme *scheme_pick(const struct sph *s);

#endif
