/* trimesh.h - surfaces made of triangles: weld, repair, place, measure. A mesh has one list of
 * vertices and one of triples; the normal of a triangle is that of (v1 - v0) x (v2 - v0). Walls
 * want it to point out of the fluid, i.e. into the solid. Everything here is local to a rank; ranks
 * that need the same mesh do the same work on the same data.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "../base/base.h"

/* A mesh. x and vertex are the data, all else follows from them by trimesh_connect and is out of
 * date after a change of them. The arrays are owned; zeroed memory is an empty mesh. */
struct trimesh {
    int nvertices, ntriangles;
    double (*x)[3];      /* [nvertices] positions of the vertices, m */
    int (*vertex)[3];    /* [ntriangles] indices into x */
    int (*neighbour)[3]; /* [ntriangles] the triangle across edge k -> k+1; -1: boundary edge */
    int *part;           /* [ntriangles] connected part, from 0 */
    int nparts;          /* connected parts */
    bool closed;         /* no triangle has a boundary edge */
    /* Number of edges with one triangle; with three or more, of which pairs of opposite sense are
     * made neighbours; with two triangles that run along it in the same sense, so that their
     * normals contradict each other. */
    int rims, junctions, clashes;
};

/* Frees the arrays and zeroes *m. */
void trimesh_free(struct trimesh *m);
/* A copy that owns arrays of its own. */
struct trimesh trimesh_copy(const struct trimesh *m);
/* Computes neighbour, part, closed and the counts of edges after x and vertex were set or
 * changed. */
void trimesh_connect(struct trimesh *m);
/* Adds copies of the triangles of `more' to m; vertices are not joined. The mesh must be connected
 * anew. */
void trimesh_append(struct trimesh *m, const struct trimesh *more);
/* Reverses the normals of one part, or of all (part -1), or of one triangle, and keeps the
 * neighbours up to date. */
void trimesh_turn(struct trimesh *m, int part);
void trimesh_turn_one(struct trimesh *m, int triangle);
/* Bounding box of the vertices, m; without vertices lo = INFINITY, hi = -INFINITY. */
void trimesh_bounds(const struct trimesh *m, double lo[3], double hi[3]);
/* Sets the unit normal n of a triangle (0 if it has no area) and returns its area, m^2. */
double trimesh_normal(const struct trimesh *m, int triangle, double n[3]);
/* Centroid of a triangle, m. */
void trimesh_middle(const struct trimesh *m, int triangle, double x[3]);
/* Where the plane across `axis' at `at', m, cuts a triangle: both ends, m. False: it does not. */
bool trimesh_cut(const struct trimesh *m, int triangle, int axis, double at, double x[2][3]);
/* Area of all triangles, m^2. */
double trimesh_area(const struct trimesh *m);
/* For each triangle a number that is shared by connected neighbours in one plane; -1 where no
 * neighbour lies in the triangle's plane. [ntriangles], owned by the caller (mem_free). */
int *trimesh_planes(const struct trimesh *m);

/* Mass properties with density 1 of what a closed surface encloses (Eberly, Polyhedral mass
 * properties, 2002, after Mirtich, J. Graphics Tools 1, 1996); volume and inertia are negative
 * where the normals point inwards. */
struct trimesh_solid {
    double volume;        /* m^3 */
    double centre[3];     /* m */
    double inertia[3][3]; /* m^5, tensor about the centre, axes of the mesh */
};
/* Of one closed part, or of all together (part -1). The mesh must be connected if part >= 0. */
struct trimesh_solid trimesh_solid(const struct trimesh *m, int part);

/* Joins vertices that lie within the tolerance, m, of each other: the one of the lowest index stays
 * where it is. Returns how many were removed; the mesh must be connected anew. */
int trimesh_weld(struct trimesh *m, double tolerance);
/* Removes triangles with two equal corners or a height over the longest edge of at most `least', m,
 * and returns how many; the mesh must be connected anew. */
int trimesh_drop_flat(struct trimesh *m, double least);
/* Drops vertices that no triangle uses and shrinks the arrays to what is in use. */
void trimesh_trim(struct trimesh *m);
/* Gives the triangles of each part one sense, that of the majority of them; returns how many were
 * turned. Surfaces with one side only, such as a Moebius strip, keep m->clashes > 0. */
int trimesh_orient(struct trimesh *m);

/* Closed solids with outward normals, already connected, owned by the caller. trimesh_box has n x n
 * squares of two triangles on each face; trimesh_sphere is an icosahedron refined `level' times, 20
 * times 4^level triangles; trimesh_prism is what a simple polygon points[n] (counter-clockwise,
 * convex or not) sweeps along z from low to high. Lengths in m. */
struct trimesh trimesh_box(const double lo[3], const double hi[3], int n);
struct trimesh trimesh_sphere(const double centre[3], double radius, int level);
struct trimesh trimesh_prism(int n, const double (*points)[2], double low, double high);
/* Cuts the simple polygon of the corners p[left[0 .. n-1]], counter-clockwise, into n - 2 triangles
 * of the same sense, and returns their number. A corner may be named twice, as at both ends of a
 * bridge to a hole. Where no ear is found, which a polygon that crosses itself may bring about, the
 * last corner is cut off. left is used up. */
int trimesh_ears(int n, int *left, const double (*p)[2], int (*ear)[3]);

/* The part of m inside the box, of which any end may be infinite, connected and owned by the
 * caller. */
struct trimesh trimesh_within(const struct trimesh *m, const double lo[3], const double hi[3]);
/* Vertices within `near', m, of the plane across `axis' at `at', m, are put on it. What a connected
 * closed mesh has beyond, on the high or on the low side, is then left out, and the mesh closed by
 * its section, normals out. false, and the mesh stays as it is but for those vertices: nothing is
 * beyond, or all of it, or the section is none of simple loops. */
bool trimesh_end(struct trimesh *m, int axis, double at, bool high, double near);

/* Where the line from a along `way' meets the plane of a triangle: the share `at' of the way, and
 * the weights u and w of its second and third corner there (Moeller & Trumbore, J. Graphics Tools
 * 2, 1997). false: the line lies in the plane, as far as `flat' tells. */
static inline bool trimesh_meet(const struct trimesh *m, int triangle, const double *a,
                                const double *way, double flat, double *u, double *w, double *at)
{
    const int *v = m->vertex[triangle];
    double d[3], e[3], p[3], q[3], s[3];
    vec3_from(m->x[v[0]], m->x[v[1]], d);
    vec3_from(m->x[v[0]], m->x[v[2]], e);
    vec3_cross(way, e, p);
    const double det = vec3_dot(d, p);
    if (fabs(det) <= flat * vec3_length(d) * vec3_length(e) * vec3_length(way))
        return false;
    vec3_from(m->x[v[0]], a, s);
    vec3_cross(s, d, q);
    *u = vec3_dot(s, p) / det;
    *w = vec3_dot(way, q) / det;
    *at = vec3_dot(e, q) / det;
    return true;
}
