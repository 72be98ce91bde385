/* wall_shadow.h - what a triangle hides from a point: the part of another triangle, or of the plane
 * through the point and an edge, that lies behind it. All places are relative to the point, m.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_SHADOW_H
#define SPH_WALL_SHADOW_H

#include "facet.h"

/* A triangle as the point sees it. */
struct shadow_caster {
    double v[3][3], n[3]; /* corners; normal away from the point */
    double side[3][3];    /* of the planes through the point and the edges, inwards */
    double height;        /* m: of the point over its plane, > 0 */
};

/* Sets *c to the triangle with the corners v; false: the point lies in its plane. */
bool shadow_caster_of(double (*v)[3], struct shadow_caster *c);
/* Whether both lie in one plane but for the last digits. */
bool shadow_alike(const struct shadow_caster *a, const struct shadow_caster *b);
/* Whether all of the polygon y[n], m, lies on the point's side of c's plane or in it, and so before
 * the shadows of all that are alike; false where rounding could tell otherwise. */
bool shadow_is_before(const struct shadow_caster *c, int n, double (*y)[3], double R);
/* Adds to *to the integrals, of the kernel with the support R, over what of the convex polygon y[n]
 * lies behind c; its corners run as those of the facets of facet.h. */
void shadow_add(const struct shadow_caster *c, int n, double (*y)[3], double R,
                struct wall_integrals *to);
/* The plane through the point and the edge a b, beyond the edge as far as R: four corners y. */
void shadow_beyond(const double *a, const double *b, double R, double (*y)[3]);

#endif
