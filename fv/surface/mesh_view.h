/* mesh_view.h - blocks as the free surface sees them: centres, metrics of cells, what counts where
 * blocks overlap, and the faces whose flux of psi ends on the surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_VIEW_H
#define FV_MESH_VIEW_H

#include "../fv.h"
#include "../grid/fv_grid.h"

/* Flux of psi through a face that has dry cells around, per unit of psi: the sum of weight times
 * psi at the places `at', plus `given' times the pressure of the cut. */
struct wet_face {
    int64_t face; /* place of the upper cell */
    int first, n; /* in the lists below */
    int cut;      /* of the cuts along the axis; -1: both cells are wet */
    double given;
};

/* What surface_mesh.out says of a ghost behind a side: psi there is mirrored (zero gradient), or
 * antisymmetric (psi = 0 on the side). */
enum { BEHIND_EVEN = 1, BEHIND_ODD = 2 };
/* Most corners of a polygon that is left of a cell. */
enum { POLYGON_MOST = 16 };
/* A convex polygon in the plane. */
struct polygon {
    int n;
    double x[POLYGON_MOST][2]; /* m */
};

/* A cell of which later blocks compute some pieces. */
struct shared_cell {
    int64_t cell, first, n; /* its pieces in the list */
    struct polygon own;     /* all of it */
};

/* These quantities for all local cells; owned. */
struct surface_mesh {
    double size[MESH_BLOCKS_MAX][3]; /* m: mean spacing of a part's cells along its indices */
    double *x[3];                    /* m: centres, with ghosts */
    bool boxes; /* lines of cells are straight and at right angles, and no cell is flat, in all
                   parts of all ranks */
    double *line[MESH_BLOCKS_MAX][3]; /* m: of boxes, places of centres along an index, from the
                                         first ghost on; NULL: `size' apart */
    double *K[3][3];                  /* -: grad xi_a . grad xi_b, times the two sizes; a <= b */
    double *slopes[3][2];             /* scratch: of a row, from below and from above */
    double *speed[3];                 /* m/s: rate along each index, times the size */
    double *count;                    /* m^dim: volume that counts */
    int64_t nshared;                  /* cells of which some counts, 2D */
    struct shared_cell *shared;
    int64_t npieces;
    struct polygon *piece;
    double *height;     /* m: of centres, against gravity */
    unsigned char *out; /* 0: a cell; else none: behind sides and in holes, where psi is mirrored
                           (BEHIND_EVEN) or has its sign turned (BEHIND_ODD: outflows) */
    /* 1: a dry cell of the fringe whose velocity is that of its block's water. */
    unsigned char *keep;
    bool slants[MESH_BLOCKS_MAX]; /* a part: index lines are neither level nor upright, or end in an
                                     overlap */
    int64_t nface[3];
    struct wet_face *face[3];
    int64_t nat, at_room;
    int64_t *at;
    double *weight;
};

struct surface;

/* Whether index lines of this part are neither along gravity nor across it. */
bool surface_inclined(const struct fv *s, const struct part *p);
/* The same of any part of any rank. */
bool surface_any_inclined(const struct fv *s);

/* surface_mesh.c: also sets the sizes of cells in f over all blocks. Collective. */
struct surface_mesh *surface_mesh_create(const struct fv *s, struct surface *f);
/* Sets speed; returns the largest sum over the indices of the rates at which the velocity crosses
 * cells, 1/s, in the band where phi is less than `band' cells off 0, over all ranks. Collective. */
double surface_mesh_speeds(const struct fv *s, double band);
/* surface_foot.c: velocity that advects phi of cell c; g: gradients of its indices, 1/m. */
void surface_foot_velocity(const struct fv *s, const struct part *p, int64_t c,
                           const double g[3][3], double u[3]);
/* Largest spacing of a part's cells, m. */
double surface_mesh_spacing(const struct fv *s, const struct part *p);
/* Ghosts of phi between blocks. What is interpolated is phi minus the height of the point, so that
 * level water is level for all blocks. Collective. */
void surface_mesh_fill(const struct fv *s, double *phi);
/* Adds sign times the height of the centres to phi, ghosts included: -1 before an interpolation, 1
 * after it. */
void surface_mesh_change_height(const struct fv *s, double sign, double *phi);
/* For blocks that move: puts all of them where they are at time t, with their donors.
 * Collective. */
void surface_mesh_place(struct fv *s, double t);
/* After that: renews centres, heights and which cells can hold water. Collective. */
void surface_mesh_update(struct fv *s);
/* Gradient of phi, -, at a cell, by central differences: exact for planes. */
void surface_mesh_gradient(const struct fv *s, const struct part *p, int64_t c, const double *phi,
                           double g[3]);
/* The tensor K of a cell, both halves. */
void surface_mesh_metric(const struct fv *s, int64_t c, double K[3][3]);

/* surface_own.c: computes which part of each cell counts where blocks overlap now. */
void surface_mesh_count(struct fv *s);
/* Water that counts in a shared cell, phi + shift < 0, m^dim. */
double surface_mesh_shared_water(const struct fv *s, const struct shared_cell *x, double shift);

/* surface_faces.c: finds cuts and faces with dry cells around, of the present layers. */
void surface_mesh_find_faces(struct fv *s);
/* Subtracts tau times the flux of psi from U of these faces. */
void surface_mesh_fluxes(const struct fv *s, double tau, const double *psi);
/* Subtracts from div, m^dim/s, tau times what the surface's pressure adds to the fluxes of psi. */
void surface_mesh_add_pressure(const struct fv *s, double tau, double *div);
/* Sets U of these faces by momentum interpolation of p with its gradient G; d, s: that of each
 * cell. */
void surface_mesh_interpolate(const struct fv *s, const double *d, double *const G[3]);
/* Gradient of psi into out[3] in wet cells whose stencils leave the water; tau: length of the
 * stage, s; change: of a variation, which is 0 on the surface. */
void surface_mesh_psi_gradient(const struct fv *s, double tau, const double *psi, bool change,
                               double *const out[3]);

/* surface_line.c: whether a part's last two wet cells of a line have slopes of their own. */
bool surface_takes_lines(const struct fv *s, const struct part *p);
/* Recomputes in these cells the gradient of psi, m/s^2, in out[3]; change: of a variation, which is
 * 0 on the surface. */
void surface_mesh_line_slopes(const struct fv *s, const double *psi, bool change,
                              double *const out[3]);

#endif
