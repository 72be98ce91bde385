/* scene_reference.h - the part of the pressure that drives nothing. Between openings, and without a
 * free surface, a flow of constant density is the same whatever is added to all pressures, and
 * gravity across bounded axes only adds the weight of a column: a field that is linear in the
 * place. A solver that leaves both out has pressures as small as those that move the
 * fluid. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_REFERENCE_H
#define COMMON_SCENE_REFERENCE_H

#include "scene.h"

struct scene_reference {
    double p, slope[3]; /* Pa at the origin, Pa/m */
};

/* Slope: rho g along axes that are not periodic; p: so that the lowest pressure given at an outflow
 * or an absorbing side is left with 0. All 0 with a free surface, where the air has pressure 0, and
 * without such sides. */
struct scene_reference scene_reference(const struct scene *s);

/* Pa at x[dim]. */
static inline double scene_reference_at(const struct scene_reference *r, int dim, const double *x)
{
    double p = r->p;
    for (int a = 0; a < dim; a++)
        p += r->slope[a] * x[a];
    return p;
}

/* Pa: what is left of the pressure given at a side of the domain, at its middle. */
double scene_reference_left(const struct scene *s, const struct scene_reference *r,
                            const struct scene_wall *w);

#endif
