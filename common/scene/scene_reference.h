/* scene_reference.h - a linear reference pressure that drives nothing. Between openings and without
 * a free surface, a flow of constant density does not change when a constant is added to all
 * pressures, and gravity across bounded axes only adds a hydrostatic pressure that is linear in x.
 * A solver that subtracts both works with pressures as small as those that move the fluid.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

/* The reference: p at the origin, Pa, and its gradient, Pa/m. */
struct scene_reference {
    double p, slope[3]; /* Pa at the origin, Pa/m */
    double
        beneath; /* Pa: added to what an opening is given, for the weight of the fluid above it */
};

/* The reference of a scene. Its gradient is rho g along axes that are not periodic; p is such that
 * the lowest pressure given at an outflow or an absorbing side becomes 0. Where gravity acts and
 * all such sides are at one height a given pressure is that at initial.level, by default the
 * highest point of the domain; else that at the middle of its side. Zero with a free surface, where
 * the air has pressure 0, and without such sides. */
struct scene_reference scene_reference(const struct scene *s);

/* The reference at x[dim], Pa. */
static inline double scene_reference_at(const struct scene_reference *r, int dim, const double *x)
{
    double p = r->p;
    for (int a = 0; a < dim; a++)
        p += r->slope[a] * x[a];
    return p;
}

/* The pressure at the middle of an opening minus the reference there, Pa. */
double scene_reference_left(const struct scene *s, const struct scene_reference *r,
                            const struct scene_wall *w);
