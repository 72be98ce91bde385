/* xdmf.h - ParaView's view of the HDF5 snapshots: one XDMF file a program, rewritten by rename
 * after each snapshot, so that it is always whole. Rank 0 only. Each call below adds one time to
 * the list and names datasets that are already in the HDF5 file; nothing is checked against that
 * file. A file that cannot be written ends the run (disk_failed).
 *
 * ParaView 5.11's readers fix the form: paths are relative, data have as many indices as the mesh.
 * Flat blocks are 2DSMesh with the coordinates of their vertices: the older reader puts a
 * 2DCoRectMesh or a 2DRectMesh into the plane of y and z, away from the particles, and cannot read
 * cells of a 3D mesh with one layer.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdint.h>

struct xdmf; /* the list of snapshots so far */

/* path: out/CASE/sph.xdmf, copied. keep: continue the list of an existing file (restart), leaving
 * out entries at or after t_restart, s. Nothing is written before the first snapshot. */
struct xdmf *xdmf_create(const char *path, bool keep, double t_restart);

/* A field of the snapshot: `name' is that of the dataset in the HDF5 file and in ParaView; ncomp 1,
 * 2 or 3 components. */
struct xdmf_field {
    const char *name; /* borrowed during the call */
    int ncomp;
};
/* n particles at time t, s; positions in dataset "position" [n][dim]. file: name of the HDF5 file
 * without folder. Fields are [n][ncomp]. */
void xdmf_points(struct xdmf *x, double t, const char *file, int64_t n, int dim, int nfields,
                 const struct xdmf_field *fields);
/* A 3D block of cells[3] uniform cells of size spacing[3], m, from corner origin[3], m. edges
 * [cells[1] + 1]: y of the grid planes where the layers have unequal heights, m, else NULL. Fields
 * are values of cells. */
void xdmf_block(struct xdmf *x, double t, const char *file, const int *cells, const double *origin,
                const double *spacing, const double *edges, int nfields,
                const struct xdmf_field *fields);
/* A flat block: its vertices, the same at all times, are dataset "vertices"
 * [cells[1] + 1][cells[0] + 1][2] of the file `grid'. */
void xdmf_flat(struct xdmf *x, double t, const char *file, const char *grid, const int *cells,
               int nfields, const struct xdmf_field *fields);
/* nblocks structured blocks of any shape: vertices in datasets x_1, x_2, ..., [cells + 1, x
 * fastest][dim], fields in NAME_1, ... with 1 or 3 components. */
void xdmf_curved(struct xdmf *x, double t, const char *file, int dim, int nblocks,
                 const int (*cells)[3], int nfields, const struct xdmf_field *fields);
/* A surface of triangles: its vertices [nvertices][3] and its triples of indices, 3 ntriangles of
 * them, may lie in two files, since the indices do not change in time. All texts are borrowed. */
struct xdmf_surface {
    const char *name, *vertices_file, *triangles_file;
    char vertices[80], triangles[80]; /* names of the datasets */
    int nvertices, ntriangles;
};
/* Adds n surfaces at time t. */
void xdmf_surfaces(struct xdmf *x, double t, int n, const struct xdmf_surface *of);
/* Adds nlines closed polylines in the plane: line k has n[k] corners in dataset "outline_K"
 * [n[k]][2], K = k + 1, and the name names[k]. */
void xdmf_outlines(struct xdmf *x, double t, const char *file, int nlines, const char *const *names,
                   const int *n);
