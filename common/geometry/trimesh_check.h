/* trimesh_check.h - what must be known of a mesh before it bounds a fluid: whether it crosses
 * itself or others, how fine it is, which way its normals point.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>

#include "tree.h"

/* Number of triangles of a that pierce triangles of b; touching is no crossing. a == b: of itself,
 * triangles with a common vertex left out. tree: that of b. *first: the lowest of them in a, -1:
 * none. Collective over comm, whose ranks all hold both meshes and share the triangles of a between
 * them; result and *first are equal on all. */
int trimesh_crossings(const struct trimesh *a, const struct tree *tree, const struct trimesh *b,
                      MPI_Comm comm, int *first);
/* How fine a mesh is. */
struct trimesh_sizes {
    double least, mean, most; /* m: lengths of edges, the mean over all edges of all triangles */
    /* Estimate of the largest distance, m, between the triangles and the smooth surface that they
     * may approximate: of edges whose triangles enclose less than 40 degrees, height times angle
     * over 4. */
    double sagitta;
};
/* Measures a connected mesh. */
struct trimesh_sizes trimesh_sizes(const struct trimesh *m);
/* Orients the closed parts of a connected mesh. sign 1: normals point out of what a part encloses;
 * of a part that lies inside another one, a hole in it, they point into the hole, so that all
 * normals leave the region between the two. sign -1: all the reverse. Returns how many parts were
 * turned. */
int trimesh_orient_closed(struct trimesh *m, int sign);
/* For a surface with boundary edges: *volume, m^3, is that between it and a cone from the centroid
 * of its boundary vertices, positive where normals point away from that; normal is the
 * area-weighted mean of the unit normals. Returns the length of `normal': 0 for a closed surface, 1
 * for a plane. */
double trimesh_openness(const struct trimesh *m, double *volume, double normal[3]);
/* 64-bit FNV-1a over the bytes of x and vertex: equal meshes in equal order have equal hashes. */
uint64_t trimesh_hash(const struct trimesh *m);
