/* bc.h - physical boundaries of the uniform grid and of layers: no-slip and slip walls, inflow,
 * outflow. Ghost averages of velocity carry the condition into all stencils; sides without a kind
 * (periodic, or imposed from the exact solution) are not touched.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_BC_H
#define FV_BC_H

#include "../fv.h"
#include "../grid/fv_grid.h"

/* The six sides as this rank has them; s->bc. Arrays are owned. */
struct bc {
    int turn[3];                      /* order of the axes in which sides are filled: 0 first */
    enum mesh_side kind[6];           /* side 2 a + (1 if upper) of axis a */
    const struct scene_wall *wall[6]; /* of the scene; NULL: none */
    bool slides[6];                   /* a wall that moves along itself */
    int64_t n[6]; /* places of a side on this rank, ghosts of its tangents included; 0: not here */
    double *w[6][3];      /* m/s: velocity on the side, averages over faces */
    double *slip[6][3];   /* m/s: what the next projection will take off the side's velocity */
    double pressure[6];   /* m^2/s^2: p/rho of an outflow, 0 elsewhere */
    bool driven;          /* some outflow's pressure is not 0 */
    bool pressure_given;  /* at an outflow: the pressure problem is regular */
    double *change[6][3]; /* m/s: of w in the step, of convective outflows; else NULL */
    double outflux;       /* m^dim/s: through this rank's faces of given velocity, outwards */
    double speed, speed_along[3]; /* m/s: largest velocity imposed, and of each component */
};

/* A face of a physical side and the cell of this rank beside it. */
struct side_face {
    enum mesh_side kind;
    const struct part *part;
    int body;                      /* 1 + that of the block, box; 0: of none */
    int side, a;                   /* of the domain or of the block: 2 a + (1 if upper) */
    int64_t cell, in;              /* the cell inside; offset one cell inwards */
    int64_t face;                  /* place in U[a] */
    double once;                   /* -: share of it that no other block has */
    double flow_area;              /* makes a flow in m^dim/s of U there */
    double friction;               /* bed friction c_f of a slip side */
    const struct scene_wall *wall; /* of the scene; NULL: a side of a block alone */
};

/* What the values of a side are imposed on. */
enum bc_value {
    BC_ZERO,   /* of a difference */
    BC_GIVEN,  /* of a velocity */
    BC_CHANGE, /* of an increment: from a projected velocity to one ahead of its projection */
    BC_AHEAD   /* of one that is still to be projected: what that takes off is added */
};

/* The sides of the case; NULL if no side has a kind. Owned by the caller (FREE). */
struct bc *bc_create(struct fv *s);
/* Kind of side k: where it has none MESH_PERIODIC or MESH_EXACT. */
enum mesh_side bc_kind(const struct fv *s, int k);
/* Kind of the side behind which the local cell `at' lies along axis a; MESH_NONE if it is
 * inside. */
enum mesh_side bc_behind(const struct fv *s, const int *at, int a);
/* Sets the ghost averages of the fields u along all sides that have a kind; ghosts of other ranks
 * must be there. */
void bc_ghosts(const struct fv *s, enum bc_value what, double *const u[3]);
/* The same for a difference (BC_ZERO) u of component q, in slab j normal to the last axis, without
 * corners: ghosts along the other axes, which must be whole on this rank. */
void bc_slab_ghosts(const struct fv *s, int q, int j, double *u);
/* The ghosts of such a field at the lower or upper end of the last axis. */
void bc_end_ghosts(const struct fv *s, int q, bool upper, double *u);
/* Sets U on walls and inflows; outflows are left as they are. */
void bc_fluxes(const struct fv *s, enum bc_value what, double *const U[3]);
/* The value one layer behind a wall of what is on faces along it, q the first in the fluid, `in' to
 * the next: by the cubic through four. Under a surface by the line through two, for what is further
 * than a layer from water has no values. */
INLINE double bc_beside_wall(const double *q, int64_t in, bool surface)
{
    return surface ? 2.0 * q[0] - q[in] : 4.0 * (q[0] + q[2 * in]) - 6.0 * q[in] - q[3 * in];
}
/* Sets U of the first faces along the tangents behind slip sides and outflows, for products of face
 * values. */
void bc_face_ghosts(const struct fv *s, double *const U[3]);
/* Calls visit for each face of these sides, as sides_visit does. */
void bc_visit(const struct fv *s, void (*visit)(const struct side_face *f, void *with), void *with);
/* Keeps tau grad psi along the walls, for BC_AHEAD. */
void bc_set_slip(const struct fv *s, double tau, const double *psi);
#endif
