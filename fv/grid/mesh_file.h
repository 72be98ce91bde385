/* mesh_file.h - vertices of a block from a file: HDF5, or Plot3D as text or binary.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "mesh.h"

/* Returns x[k][j][i][dim], m, and sets the numbers of cells; NULL: a fault was added. Owned by the
 * caller (mem_free). Rank 0 reads; collective over r->comm. */
double *mesh_file_read(const struct run *r, struct faults *f, const struct mesh_block_params *p,
                       int *cells);
