/* forcing.h - cells whose velocity is imposed: a hole that another method fills, a box with the
 * exact solution, the cells behind closed sides. They take no part in the pressure; two layers of
 * them carry the stencils of the free cells, three those of a partner's interpolation.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FORCING_H
#define FV_FORCING_H

#include "../fv.h"

enum {
    NEAR = 4,  /* layers of imposed cells that get values */
    AHEAD = 3, /* more of them where a partner's box moves: they have a past when they come near */
    REACH = 3  /* cells to either side in a one-sided gradient */
};

/* How a field is extrapolated into imposed cells: zero gradient (psi), by a cubic (p), or as a
 * variation of p. */
enum continuation { CONTINUE_EVEN, CONTINUE_CUBIC, CONTINUE_VARIATION };

/* What the gradient of a free cell near the interface has beyond the plain form: weights of the
 * cells from -REACH to REACH along the axis, 1/m. */
struct fix {
    double cubic[2 * REACH + 1], even[2 * REACH + 1];
    double given; /* what an outflow's pressure adds to the cubic one, m/s^2 */
};

/* Who takes the net flux of the interface with imposed cells. A partner's density is not constant,
 * and its surplus must not drive the flow between it and an outflow. */
enum net_flux {
    NET_INTERFACE, /* its faces, uniformly: it has a whole inside */
    NET_SIDES,     /* they do, with that of walls and inflows: nothing leaves elsewhere */
    NET_OTHERS     /* an outflow, or all cells in the solve for psi: the interface ends there */
};

struct one_sided; /* given_cells.c */
struct parted;    /* parted.h */

/* The imposed cells of this rank and their values; s->forcing. Arrays are owned. */
struct forcing {
    int dim;
    unsigned char *forced; /* [size] 1: forced (ghosts too), 2: behind a closed side, 3: in a
                              blocked box, 4: of blocks: no cell */
    /* [size] of an imposed cell: distance from the free ones, 1 ..; 0: deep or free. */
    unsigned char *layer;
    int64_t nlocal, *local; /* imposed cells of this rank */
    int64_t nset,
        *set; /* cells that this rank gives values: local near ones, ghosts behind closed sides */
    int64_t npartner, nrim,
        *partner; /* in the order of a partner's values: npartner local near cells of the hole, then
                     nrim free ones beside its interface, whose values serve the fluxes alone */
    int near;     /* layers of imposed cells that get values */
    bool *known;  /* [size] a partner gives it, ghosts too */
    double *given[3]; /* [size] its velocities at the time of a flux */
    int64_t nfix[3];
    struct fix *fix[3];         /* one-sided gradients along each axis */
    int64_t *fix_cell[3];       /* where: apart, as under a surface most of them are dry */
    struct one_sided *gradient; /* those of blocks; NULL: no blocks */
    /* faces of the interface: index in U, sign of the flow out of the fluid, whether this rank
     * counts it */
    int64_t nface[3], *face[3];
    signed char *sign[3];
    bool *counts[3];
    double *open[3];    /* [size] 1: both cells of the face are free; blocks have mesh.open */
    int64_t free_cells; /* of all ranks */
    bool from_partner;
    bool whole; /* psi is the whole pressure, not its change: into a partner's cells it goes on as p
                   does */
    bool imposed; /* some rank gives cells the exact velocity */
    enum net_flux net;
    struct parted *parted; /* NULL: all computed cells are one part, or each has an outlet */
    double *v[3], *v_next[3], *v_old[3]; /* [npartner + nrim] partner's velocities at t0, t1, and
                                            the coupling step before */
    double inflow; /* m/s: added to the flow through the interface, into the free cells, whose
                      surface lets it in; 0 without a surface */
    double t0, t1, t_old; /* s */
    int levels;           /* of them known, the newest first: v_next, v, v_old */
};

/* partner: the n boxes (lower, upper corner, m) are filled by partners, else by the exact solution;
 * cells all of whose corners lie inside one are imposed; lo >= hi: no box. NULL if nothing is
 * imposed. Owned by the caller. Collective. */
struct forcing *forcing_create(const struct fv *s, int n, const double (*box)[2][3], bool partner);
/* Whether a cell of this rank is solved for; on blocks dry cells are not. */
static inline bool forcing_is_free(const struct fv *s, int64_t c)
{
    return s->free ? s->free[c] > 0.0 : !(s->forcing && s->forcing->forced[c]);
}
/* Sets q to zero in the imposed cells of this rank. */
void forcing_zero(const struct forcing *f, double *q);
/* The next coupling step, t0 to t1, s, begins: v becomes v_next, whose new values are extrapolated
 * from the last coupling steps, by a parabola as soon as there are three. A cubic would amplify
 * noise where the loop's gain is half of what parabolas bear. */
void forcing_shift(struct forcing *f, double t0, double t1);
/* Sets u in the imposed cells to their values at time t. */
void forcing_velocity(const struct fv *s, double t, double *const u[3]);
/* delta -= u in the imposed cells. */
void forcing_subtract(const struct forcing *f, double *const u[3], double *const delta[3]);
/* Sets the fluxes of the interface at time t: exact ones where the exact solution is imposed, a
 * partner's where its values reach two cells to both sides, else as they are interpolated; then
 * they are corrected uniformly to no net flux, which a free surface takes instead. The free cells'
 * own velocities contain the pressure of the step before: fluxes made of them would let the
 * pressure lag. Collective. */
void forcing_fluxes(const struct fv *s, double t, double *const U[3]);
/* Sets the partner's newest values where it gave none (mask 0) to means of those beside them, layer
 * by layer, for cells in the air above its water. Collective. */
void forcing_fill(const struct fv *s, const unsigned char *mask);
/* How these fluxes vary with the velocity that U was interpolated from. */
void forcing_fluxes_variation(const struct fv *s, double *const U[3]);
/* Adds to the gradient `out' of q along axis a the effect of extrapolating q into the imposed
 * cells: with zero gradient, or by a cubic (of lower degree where fewer than four free cells stand
 * in line). dry: not 0 in cells that are left alone, since the surface makes their gradient; NULL:
 * none. */
void forcing_gradient(const struct fv *s, int a, enum continuation how, const unsigned char *dry,
                      const double *q, double *out);
/* forcing_fixes.c: computes the weights for this along axis a. */
void forcing_list_fixes(const struct fv *s, struct forcing *f, int a);
/* Extends p into the near imposed cells from the free side, `layers' layers, one by one. */
void forcing_extend(const struct fv *s, int layers, double *p);

/* mesh_exact.c: averages of the exact solution at t over cell `at' of a part: u, m/s, pressure, Pa,
 * vorticity w, 1/s (NULL: not wanted). forcing_average: of the cell at place c. */
void cell_exact(const struct fv *s, const struct part *p, const int *at, double t, double *u,
                double *pressure, double *w);
void forcing_average(const struct fv *s, int64_t c, double t, double *v, double *pressure);

/* given_cells.c, for blocks: finds the gradients that need one-sided stencils. */
void given_rows_create(const struct fv *s, struct forcing *f);
/* Replaces the gradients of computed cells near imposed ones by those of q extrapolated along the
 * indices. */
void given_gradient(const struct fv *s, enum continuation how, const double *q, double *const g[3]);
/* The i-th cell with such a gradient, and the n places of its stencil; false: there are fewer. */
bool given_stencil(const struct forcing *f, int64_t i, int64_t *cell, int64_t *n,
                   const int64_t **place);
/* Sets psi of imposed cells beside free ones to the mean of those, as the rows of the matrix have
 * it, with ghosts. */
void given_mirror(const struct fv *s, double *psi);
/* Flow through the lower face of c along a, m^dim/s: of the exact solution at t; given_flux_of: of
 * the averages v, with ghosts. */
double given_exact_flux(const struct fv *s, int64_t c, int a, double t);
double given_flux_of(const struct fv *s, double *const v[3], int64_t c, int a);

#endif
