/* xdmf.h - ParaView's view of the HDF5 snapshots: one XDMF file a program, rewritten by rename
 * after each snapshot so that it is always whole. Rank 0 only. ParaView 5.11's readers fix the
 * form: paths are relative, data have as many indices as the mesh. Flat blocks are 2DSMesh with
 * the places of their vertices: the older reader puts a 2DCoRectMesh or a 2DRectMesh into the plane
 * of y and z, away from the particles, and cannot read cells of a 3D mesh with one layer.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_XDMF_H
#define COMMON_XDMF_H

#include <stdbool.h>
#include <stdint.h>

struct xdmf; /* the list of snapshots so far */

/* path: out/CASE/sph.xdmf. keep: continue the list of an existing file (restart), leaving out
 * entries at or after t_restart. */
struct xdmf *xdmf_create(const char *path, bool keep, double t_restart);
void xdmf_free(struct xdmf **x); /* sets *x to NULL */

/* A field of the snapshot: dataset name in the HDF5 file, 1 or 2 or 3 components. */
struct xdmf_field {
    const char *name;
    int ncomp;
};
/* n particles, positions in dataset "position" [n][dim]. file: name of the HDF5 file, no folder. */
void xdmf_points(struct xdmf *x, double t, const char *file, int64_t n, int dim, int nfields,
                 const struct xdmf_field *fields);
/* A block of even cells in 3D; edges: of its rows along y [cells[1] + 1] where they are of unequal
 * height, else NULL. */
void xdmf_block(struct xdmf *x, double t, const char *file, const int *cells, const double *origin,
                const double *spacing, const double *edges, int nfields,
                const struct xdmf_field *fields);
/* A flat block: its vertices, the same at all times, are dataset "vertices"
 * [cells[1] + 1][cells[0] + 1][2] of the file `grid'. */
void xdmf_flat(struct xdmf *x, double t, const char *file, const char *grid, const int *cells,
               int nfields, const struct xdmf_field *fields);
/* Structured blocks of any shape: vertices in datasets x_1, x_2, ..., fields in NAME_1, ... */
void xdmf_curved(struct xdmf *x, double t, const char *file, int dim, int nblocks,
                 const int (*cells)[3], int nfields, const struct xdmf_field *fields);
/* Surfaces of triangles: vertices [nvertices][3] of one file, 3 ntriangles indices of another. */
struct xdmf_surface {
    const char *name, *vertices_file, *triangles_file;
    char vertices[80], triangles[80]; /* names of the datasets */
    int nvertices, ntriangles;
};
void xdmf_surfaces(struct xdmf *x, double t, int n, const struct xdmf_surface *of);
/* Closed lines in the plane: line k has n[k] corners in dataset "outline_K", K from 1. */
void xdmf_outlines(struct xdmf *x, double t, const char *file, int nlines, const char *const *names,
                   const int *n);

#endif
