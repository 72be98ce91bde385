/* trimesh.h - surfaces made of triangles: read, weld, check, place, measure.
 * A mesh has one list of vertices and one of triples; the normal of a triangle is that of
 * (v1 - v0) x (v2 - v0). Walls want it out of the fluid, i.e. into the solid.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_TRIMESH_H
#define COMMON_TRIMESH_H

#include <stdbool.h>
#include <stdint.h>

struct trimesh {
    int nvertices, ntriangles;
    double (*x)[3];      /* [nvertices], m */
    int (*vertex)[3];    /* [ntriangles] */
    int (*neighbour)[3]; /* [ntriangles] across the edge k -> k+1; -1: edge of an open surface */
    int *part;           /* [ntriangles] connected part, from 0 */
    int nparts;
    bool closed; /* every part is */
    /* Edges of one triangle; of three and more; of two that run it in the same sense. */
    int rims, junctions, clashes;
};

void trimesh_free(struct trimesh *m);
struct trimesh trimesh_copy(const struct trimesh *m);
/* neighbour, part and what hangs on them, after x and vertex were set or changed. */
void trimesh_connect(struct trimesh *m);
/* Adds the triangles of `more'; both must be joined by trimesh_connect afterwards. */
void trimesh_append(struct trimesh *m, const struct trimesh *more);
/* Turns the normals of one part, or of all (-1). */
void trimesh_turn(struct trimesh *m, int part);
void trimesh_bounds(const struct trimesh *m, double lo[3], double hi[3]);
/* Unit normal of a triangle (0: it has none) and its area, m^2. */
double trimesh_normal(const struct trimesh *m, int triangle, double n[3]);
void trimesh_middle(const struct trimesh *m, int triangle, double x[3]);
double trimesh_area(const struct trimesh *m);
/* For each triangle a number that neighbours in one plane share, -1 where no neighbour lies in its
 * plane; [ntriangles], the caller's. */
int *trimesh_planes(const struct trimesh *m);

/* What a closed surface holds, with density 1 (Eberly, Polyhedral mass properties, 2002, after
 * Mirtich, J. Graphics Tools 1, 1996): negative where its normals point in. */
struct trimesh_solid {
    double volume;        /* m^3 */
    double centre[3];     /* m */
    double inertia[3][3]; /* m^5, about the centre */
};
struct trimesh_solid trimesh_solid(const struct trimesh *m, int part); /* -1: all */

/* Makes vertices one that lie within the tolerance, m, of each other: the first met stays. Returns
 * how many went; the mesh must be connected anew. */
int trimesh_weld(struct trimesh *m, double tolerance);
/* Takes out triangles of two equal corners, or of a height of at most `least', m; connect anew. */
int trimesh_drop_flat(struct trimesh *m, double least);
/* Gives back the memory that lists of before need no more, and vertices that no triangle has. */
void trimesh_trim(struct trimesh *m);
/* Gives each part one sense, that of most of its triangles; returns how many were turned. What has
 * but one side keeps clashes. */
int trimesh_orient(struct trimesh *m);

/* Solids with normals out, connected. A box with n x n squares of two triangles a face; a sphere of
 * 20 times 4^level triangles; what a polygon (counter-clockwise, convex or not) sweeps along z. */
struct trimesh trimesh_box(const double lo[3], const double hi[3], int n);
struct trimesh trimesh_sphere(const double centre[3], double radius, int level);
struct trimesh trimesh_prism(int n, const double (*points)[2], double low, double high);

#endif
