/* wall_friction.h - viscous friction of normal flux walls on a particle, as a weight of each piece
 * over a height. Particles and walls local to the rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_FRICTION_H
#define SPH_WALL_FRICTION_H

#include "wall_list.h"

enum { OWNER_NONE = -2 };

/* Of one particle. */
struct wall_friction {
    double pairs[3], walls[3]; /* m^(1-dim): sum w F d over pairs, sum W n over walls */
    double velocity[3];        /* m/s: of the owner's nearest no-slip point */
    double toward[3], apart;   /* to that: unit vector; m */
    double least;              /* m: heights below count as this */
    int owner;                 /* whose: a body, -1: what is at rest */
};

/* For particle k of the list, of the Shepard factor gamma; of Morris's term with the sums over its
 * neighbours, if a no-slip wall is near. Once a stage, before the rates. */
void wall_friction_begin(const struct sph *s, const struct wall_list *l, int k, double gamma,
                         struct wall_friction *f);
/* Sets q[dim], N/m^dim, to the friction of touch t of particle k, a no-slip piece that moves at uw,
 * m/s; mu, Pa s. Touches of one owner come together. */
void wall_friction_of(const struct sph *s, const struct wall_list *l, int k,
                      const struct wall_touch *t, const double *uw, double mu,
                      struct wall_friction *f, double *q);
/* Moves the friction q on particle k by touch t, over the volume w, m^dim, from the particle's
 * place, where forces_add has it, to half way to the wall. */
void wall_friction_couple(const struct sph *s, const struct wall_list *l, int k,
                          const struct wall_touch *t, const double *q, double w);

#endif
