/* tree.h - bounding volumes round the triangles of a mesh, in the mesh's own frame: who is near a
 * box, what is nearest to a point and on which side, what a segment meets.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_TREE_H
#define COMMON_TREE_H

#include "trimesh.h"

struct tree;

/* m is borrowed until tree_free; it must be connected. */
struct tree *tree_create(const struct trimesh *m);
void tree_free(struct tree **t);
/* Triangles whose boxes meet [lo, hi], ascending; returns their number, of which at most `most' are
 * written to who (more of them than that: any). */
int tree_box(const struct tree *t, const double lo[3], const double hi[3], int most, int *who);
/* Nearest point of the surface to x, not farther than reach: its distance, negative behind it, i.e.
 * on the side that the normals point to, by the angle-weighted pseudonormal of the nearest feature
 * (Baerentzen & Aanaes, IEEE TVCG 11, 2005); INFINITY: none. */
struct tree_foot {
    double distance; /* m, signed */
    double foot[3];  /* m */
    double n[3];     /* unit pseudonormal */
    int triangle;
    bool rim; /* on the boundary edge of an open surface: the side means nothing */
};
struct tree_foot tree_nearest(const struct tree *t, const double x[3], double reach);
/* Whether the segment a -> b meets a triangle; where: share of the way to the first, may be NULL.
 */
bool tree_crosses(const struct tree *t, const double a[3], const double b[3], double *where);
/* Winding number (van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30, 1983): 1 inside normals
 * that point out, 0 outside; O(n). */
double trimesh_winding(const struct trimesh *m, const double x[3]);

#endif
