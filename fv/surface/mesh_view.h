/* mesh_view.h - blocks as the free surface sees them: places of centres, metrics of cells, what
 * counts where blocks overlap, and the faces whose flux of psi ends on the surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_VIEW_H
#define FV_MESH_VIEW_H

#include "../fv.h"
#include "../grid/mesh.h"

/* Flux of psi (per unit of it) through a face that has dry cells around: sum of weight times psi
 * at the places `at' and of `given' times the pressure of the cut. */
struct wet_face {
    int64_t face; /* place of the upper cell */
    int first, n; /* in the lists below */
    int cut;      /* of the cuts along the axis; -1: both cells are wet */
    double given;
};

struct surface_mesh {
    double size[MESH_BLOCKS_MAX][3]; /* m: mean spacing of a part's cells along its indices */
    double *x[3];                    /* m: centres, with ghosts */
    double *K[3][3];                 /* -: grad xi_a . grad xi_b, times the two sizes; a <= b */
    double *slopes[3][2];            /* scratch: of a row, from below and from above */
    double *speed[3];                /* m/s: rate along each index, times the size */
    double *count;                   /* m^dim: volume that counts */
    unsigned char *out;              /* 1: no water can be there: behind walls, in holes */
    bool slants[MESH_BLOCKS_MAX]; /* a part: index lines are neither level nor upright, or end in an
                                     overlap */
    bool slanting;                /* some block has such lines */
    bool keeps;                   /* slopes of phi behind inclined walls stay as they are */
    int64_t nface[3], face_room[3];
    struct wet_face *face[3];
    int64_t nat, at_room;
    int64_t *at;
    double *weight;
};

/* surface_mesh.c: *least, *largest: m, heights of cells over all blocks. Collective. */
struct surface_mesh *surface_mesh_create(const struct fv *s, double *least, double *largest);
void surface_mesh_free(struct surface_mesh **m);
/* Rates at which the velocity crosses cells; the largest sum over the indices, 1/s, in the band
 * where |phi| is less than `band' sizes of cells, over all ranks. */
double surface_mesh_speeds(const struct fv *s, double band);
/* Largest spacing of a part's cells, m. */
double surface_mesh_spacing(const struct fv *s, const struct part *p);
/* Gradient of phi (1) at a cell, by central differences. */
void surface_mesh_gradient(const struct fv *s, const struct part *p, int64_t c, const double *phi,
                           double g[3]);
/* K of a cell, both halves. */
void surface_mesh_metric(const struct fv *s, int64_t c, double K[3][3]);

/* surface_faces.c: cuts and faces with dry cells around, of the present layers. */
void surface_mesh_find_faces(struct fv *s);
/* U of these faces less tau times the flux of psi. */
void surface_mesh_fluxes(const struct fv *s, double tau, const double *psi);
/* div (m^dim/s) less tau times what the surface's pressure adds to the fluxes of psi. */
void surface_mesh_add_pressure(const struct fv *s, double tau, double *div);
/* out[3] = grad psi in wet cells whose stencils leave the water. */
void surface_mesh_psi_gradient(const struct fv *s, const double *psi, double *const out[3]);

#endif
