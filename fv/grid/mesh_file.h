/* mesh_file.h - vertices of a block from a file: HDF5, or Plot3D as text or binary.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_FILE_H
#define FV_MESH_FILE_H

#include "mesh.h"

/* x[k][j][i][dim] and the numbers of cells; NULL: a fault was added. Owned by the caller. Rank 0
 * reads; collective. */
double *mesh_file_read(const struct run *r, struct faults *f, const struct mesh_block_params *p,
                       int *cells);

#endif
