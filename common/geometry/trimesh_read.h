/* trimesh_read.h - triangles from files of other programs. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_TRIMESH_READ_H
#define COMMON_TRIMESH_READ_H

#include <mpi.h>
#include <stddef.h>

#include "trimesh.h"

/* Reads STL (text, binary), OBJ or PLY: every corner of every triangle as the file has it, neither
 * welded nor connected. false: why says what is wrong and what helps. On one rank. */
bool trimesh_read(const char *path, struct trimesh *m, char *why, size_t size);
/* Whether this program was built with a reader. */
bool trimesh_has_reader(void);
/* What rank 0 has, connected, to all ranks. Collective. */
void trimesh_broadcast(struct trimesh *m, MPI_Comm comm);

#endif
