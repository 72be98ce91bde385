/* tree.h - a bounding volume tree over the triangles of a mesh, in the mesh's own frame: which
 * triangles are near a box, which point is nearest to a given one and on which side of the surface
 * it lies, what a segment meets. Queries are local to a rank, O(log n), and do not change the tree.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "trimesh.h"

struct tree;

/* Builds the tree. m is borrowed until the tree is freed and must be connected (trimesh_connect);
 * if its vertices move, the tree must be built anew. A mesh without triangles is legal. */
struct tree *tree_create(const struct trimesh *m);
/* Writes the triangles whose bounding boxes meet [lo, hi], m, to who[most], ascending, and returns
 * their number. If it is more than `most', an arbitrary selection is written: call again with more
 * room. */
int tree_box(const struct tree *t, const double lo[3], const double hi[3], int most, int *who);
/* The point of the surface that is nearest to x: a foot of the perpendicular, or on an edge or
 * vertex. */
struct tree_foot {
    double distance; /* m; negative behind the surface, on the side that the normals point to */
    double foot[3];  /* m */
    double n[3];     /* unit angle-weighted pseudonormal of the nearest face, edge or vertex */
    int triangle;    /* the one with the foot; -1: none within reach */
    bool rim; /* the foot is on the boundary edge of an open surface: the sign means nothing */
};
/* Nearest point of the surface to x, not farther than reach, m. The side is told by the
 * angle-weighted pseudonormal of the nearest feature (Baerentzen & Aanaes, IEEE TVCG 11, 2005),
 * which is right on edges and vertices, too. Distance INFINITY: the surface is farther. */
struct tree_foot tree_nearest(const struct tree *t, const double x[3], double reach);
/* The foot as a sheet with fluid on both sides has it: whatever is near it is before it. */
static inline struct tree_foot tree_foot_of_sheet(struct tree_foot f)
{
    const double way = f.distance < 0.0 ? -1.0 : 1.0;
    f.distance *= way;
    for (int a = 0; a < 3; a++)
        f.n[a] *= way;
    return f;
}

/* Whether the segment a -> b meets a triangle, edges included (Moeller & Trumbore, J. Graphics
 * Tools 2, 1997). *where: fraction of the way from a to the first one, untouched if there is none;
 * NULL: not wanted, which is faster. */
bool tree_crosses(const struct tree *t, const double a[3], const double b[3], double *where);
/* Winding number of a closed mesh round x (van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30,
 * 1983): 1 inside a surface whose normals point outwards, 0 outside. Needs no tree and costs
 * O(n). */
double trimesh_winding(const struct trimesh *m, const double x[3]);
