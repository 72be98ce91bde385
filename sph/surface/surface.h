/* surface.h - which particles lie on a free surface (Marrone et al., J. Comput. Phys. 229, 2010),
 * once a step: the smallest eigenvalue of M [2.42], which the first pass over the pairs sums
 * anyway, and between its bounds a search for neighbours in a cone along the normal [3.12].
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SURFACE_H
#define SPH_SURFACE_H

#include <math.h>

#include "../sph.h"

enum surface_class { SURFACE_INNER, SURFACE_NEAR, SURFACE_ON };

struct free_surface {
    int capacity;
    unsigned char *is; /* [n] enum surface_class of the locals */
    double *normal;    /* [n][dim] out of the fluid: on and near the surface, else 0 */
    double *M, *g;     /* [n][dim^2], [n][dim] moments with wall terms */
    double *lambda;    /* [n] smallest eigenvalue of M; 1 where there are neighbours enough */
    double *less;      /* [n] volume_feedback.h: sum w W of the first pass, then the share of their
                          room that volumes lack; if `follows' */
    int less_capacity;
    bool follows;
    bool fades;   /* shifts do, towards the surface [5.14], for comparison */
    double reach; /* m: near is within this of a particle on the surface */
    bool known;   /* detected for the present places; else the first pass fills M */
};

/* The law of transition [5.16] (exponent 4: illegible in print, the best reading), v = 1 - sum w W:
 * the whole shift below 0.1, nothing from 0.5 on. */
static inline double surface_beta(double v)
{
    const double b = 1.0 - fmax(0.0, fmin(v, 0.5) - 0.1) / 0.4;
    return b * b * b * b;
}

/* NULL: no free surface in the scene. */
struct free_surface *sph_surface_create(struct sph *s);
void sph_surface_free(struct free_surface **f);
/* Room for n locals. */
void surface_room(struct free_surface *f, int n, int dim);
/* After the first pass. Collective. */
void surface_detect(struct sph *s);
/* Takes the divergence out of the gradients of u as far as the support lacks neighbours: lambda
 * from 1 (none of it) to 0.75 (all). For the damper. */
void surface_calm(struct sph *s);

/* transport.c: the last word on u0 = u + delta at every stage, after wall terms: nothing on a
 * surface, along it near it, and the largest size [2.113]. */
void transport_finish(struct sph *s);

#endif
