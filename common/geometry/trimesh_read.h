/* trimesh_read.h - triangles from files of other programs, through the library assimp where the
 * program was built with it. The library hands out single precision.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>
#include <stddef.h>

#include "trimesh.h"

/* Reads STL (text or binary), OBJ or PLY into *m (owned by the caller): every corner of every
 * triangle as the file has it, neither welded nor connected. false: why[size] says what is wrong
 * and what helps. Called on one rank, then trimesh_broadcast. */
bool trimesh_read(const char *path, struct trimesh *m, char *why, size_t size);
/* Whether this program was built with a reader. */
bool trimesh_has_reader(void);
/* Copies the connected mesh of rank 0 to all ranks. Collective over comm. */
void trimesh_broadcast(struct trimesh *m, MPI_Comm comm);
