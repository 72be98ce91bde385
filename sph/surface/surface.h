/* surface.h - which particles lie on a free surface (Marrone et al., J. Comput. Phys. 229, 2010),
 * once a step: the smallest eigenvalue of M [2.42], which the first pass over the pairs sums
 * anyway, and between its bounds a search for neighbours in a cone along the normal [3.12].
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* Inside; within reach of a particle on the surface; on it. */
enum surface_class { SURFACE_INNER, SURFACE_NEAR, SURFACE_ON };

/* What was detected. All arrays have `capacity' entries and are owned. */
struct free_surface {
    int capacity;
    unsigned char *is; /* [n] enum surface_class of the locals */
    double *normal;    /* [n][dim] unit vector out of the fluid: on and near the surface, else 0 */
    double *M, *g;     /* [n][dim^2], [n][dim] moments with wall terms */
    double *lambda;    /* [n] smallest eigenvalue of M; 1 where there are neighbours enough */
    /* [n] volume_feedback.h: sum w W after the first pass, then the share of their room that
     * volumes lack; if `follows'. */
    double *less;
    int less_capacity;
    bool follows; /* volumes are corrected in this step */
    bool fades;   /* shifts fade towards the surface [5.14], for comparison */
    double reach; /* m: near is within this of a particle on the surface */
    bool known;   /* detected for the present list; else the first pass fills M */
};

/* The law by which the shift fades [5.16] (exponent 4: illegible in print, the best reading), with
 * v = 1 - sum w W: 1 below 0.1, 0 from 0.5 on. */
static inline double surface_beta(double v)
{
    const double b = 1.0 - fmax(0.0, fmin(v, 0.5) - 0.1) / 0.4;
    return b * b * b * b;
}

/* NULL: the scene has no free surface. Owned by the caller (FREE). */
struct free_surface *sph_surface_create(struct sph *s);
/* Makes room for n locals; contents are kept. */
void surface_room(struct free_surface *f, int n, int dim);
/* Classifies the locals, after the first pass. SURFACE_NEAR and its normals are found for the
 * transport velocities tvs and tvo alone, for only those use them. Collective. */
void surface_detect(struct sph *s);
/* Whether neighbours of local i are missing because the surface is near, not for walls alone. */
bool surface_reaches(const struct sph *s, int i);
/* For the acoustic damper: removes the divergence from the gradients of u as far as the support
 * lacks neighbours, from lambda = 1 (nothing) to 0.75 (all), since there it is an error and no
 * sound. Where walls and no surface make lambda small it does so in water nearly at rest alone: in
 * streams damper.c finds the error. */
void surface_calm(struct sph *s);

/* In transport.c: the last correction of u0 = u + delta in every stage, after wall terms. delta is
 * 0 on a surface, along it near it, and bounded in size [2.113]. */
void transport_finish(struct sph *s);

/* Square of the speed of a particle at the velocity u[dim], m^2/s^2. Where one stream carries all
 * water alike (struct sph_step, carried) that is relative to the stream: what rests in it counts as
 * water at rest. */
double transport_speed2(const struct sph *s, const double *u);
