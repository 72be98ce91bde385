/* facet.h - integrals of Wendland's C2 kernel over a triangle of a wall in closed form: its part of
 * the Shepard factor [4.60-4.82] (Chiron 2017), its weight and the centre of that weight. Sums over
 * the edges of polynomials, two angles and a logarithm, for many edges at once.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_FACET_H
#define SPH_FACET_H

#include <stdbool.h>

/* A triangle v0 v1 v2 with what the integrals need of it; n is on the side from which the corners
 * run counter-clockwise: out of the fluid. */
struct facet {
    double v[3][3]; /* m */
    double n[3], t[3][3],
        m[3][3];              /* unit vectors: normal; along an edge; out of it, in the plane */
    double length[3];         /* m: of the edges */
    double centre[3], radius; /* m: mean of the corners, farthest corner from there */
    double longest, area;     /* m, m^2 */
};

/* The facet with the corners a, b, c, m. */
struct facet facet_of(const double *a, const double *b, const double *c);

/* Integrals over a piece of wall of the kernel around a particle at x. */
struct wall_integrals {
    double gamma; /* -: 1 + sum of it over the walls is the Shepard factor */
    double W;     /* m^(1-dim): int W dS */
    double e[3];  /* m^(2-dim): int W (y - x) dS */
};

/* Where a particle is relative to a triangle. */
struct facet_place {
    double height;   /* m: over its plane, > 0 on the side of the fluid */
    double distance; /* m: to the triangle; of small far ones to their centre */
    bool foot;       /* the foot of the particle lies on the triangle */
};

/* Edges that are collected until there are enough of them for the vector loops. Start with n =
 * 0. */
enum { FACET_EDGES = 256 };
struct facet_batch {
    int n;
    double p[FACET_EDGES] __attribute__((aligned(64))), d[FACET_EDGES], a[FACET_EDGES],
        b[FACET_EDGES];
    double *to[FACET_EDGES]; /* gamma, W, e */
    const double *m[FACET_EDGES], *normal[FACET_EDGES];
    double D[FACET_EDGES], R[FACET_EDGES];
};

/* Adds the integrals of f for the support R, m, around x to *to, at the latest in facet_finish; f
 * and to are borrowed until then. Triangles that are small against their distance are integrated by
 * points, with errors below 1e-5 of gamma. */
struct facet_place facet_ask(struct facet_batch *b, const struct facet *f, const double *x,
                             double R, struct wall_integrals *to);
void facet_finish(struct facet_batch *b);
/* For comparison, W and e by quadrature instead: facet_clip by n x n squares clipped by the
 * triangle, facet_centroid by one point. */
void facet_clip(const struct facet *f, const double *x, double R, int n, struct wall_integrals *to);
void facet_centroid(const struct facet *f, const double *x, double R, struct wall_integrals *to);
/* Integral of W over the plane through x and an edge, beyond the edge as seen from x, 1/m. */
double facet_rim(const struct facet *f, int edge, const double *x, double R);
/* Sets foot to the point of f nearest to x; returns its distance, m. */
double facet_nearest(const struct facet *f, const double *x, double *foot);

#endif
