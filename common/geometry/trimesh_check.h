/* trimesh_check.h - what is to be known of a mesh before a fluid meets it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_TRIMESH_CHECK_H
#define COMMON_TRIMESH_CHECK_H

#include <mpi.h>

#include "tree.h"

/* Triangles of a that pierce triangles of b (a == b: of itself, neighbours left out); first: the
 * lowest of them in a, -1: none. Collective over comm: each rank looks at its share. */
int trimesh_crossings(const struct trimesh *a, const struct tree *tree, const struct trimesh *b,
                      MPI_Comm comm, int *first);
/* Lengths of the sides, m. */
struct trimesh_sizes {
    double least, mean, most;
    /* About the largest distance between the triangles and the smooth surface that they may stand
     * for, m: of edges bent by less than 40 degrees. */
    double sagitta;
};
struct trimesh_sizes trimesh_sizes(const struct trimesh *m);
/* A closed part with its normals into what it encloses, a part inside of another one the other
 * way round; sign -1: all the reverse. Returns how many parts were turned. */
int trimesh_orient_closed(struct trimesh *m, int sign);
/* Of an open surface: volume under a cover from the middle of its boundary, and its mean normal by
 * area, of length 0 of a closed one, 1 of a plane. Returns that length. */
double trimesh_openness(const struct trimesh *m, double *volume, double normal[3]);
/* 64-bit FNV-1a of vertices and triples. */
uint64_t trimesh_hash(const struct trimesh *m);

#endif
