/* zones.h - free, transition and buffer zones of a particle region inside a larger flow (Chiron
 * 2017, 6.2-6.3). In the buffer the outer solution is imposed, in the transition it is blended in,
 * in the free zone particles are on their own. The outer solution is a function of position and
 * time: an exact solution, the patch of a partner, or sides.h. Creation and removal at the outer
 * face: openings.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_ZONES_H
#define SPH_ZONES_H

#include "../sph.h"

/* The outer solution: u[n][dim], m/s, p[n], Pa, and their gradients gu[n][dim][3], gp[n][3] (NULL:
 * not wanted) at x[n][3], m, and t, s. */
typedef void zones_eval(void *ctx, double t, int n, const double *x, double *u, double *p,
                        double *gu, double *gp);

/* Height over the outer solution's surface, m, < 0 in water, and its gradient gphi[n][3] (NULL: not
 * wanted). */
typedef void zones_surface(void *ctx, double t, int n, const double *x, double *phi, double *gphi);

struct openings;
struct overlap;
struct level_gap;
/* The zones of a region and their outer solution. */
struct zones {
    int dim;
    double dx, lo[3], hi[3];   /* m: of the region */
    bool open[6];              /* sides, 2a: low, 2a + 1: high */
    double transition, buffer; /* m: widths */
    double overlap;       /* m: width of the margin of the free zone where a partner is free, too */
    double counted[2][3]; /* m: zones_counted_box, as the coupling step has begun */
    bool along[3];        /* the box moves along this axis */
    double way[3],
        speed[3]; /* m, m/s: displacement of the box since the start, velocity over the last step */
    double fastest;    /* m/s: largest speed that the box will have */
    double tracked[3]; /* m/s: smoothed speed of what the box follows, box_tracking.h */
    zones_eval *eval;  /* the outer solution */
    struct sph_eos {
        double rho0, c0, gamma;
    } eos; /* the particles', for a partner of constant density */
    zones_surface
        *surface; /* of the outer solution, if it has a free surface; NULL: full of water */
    struct level_gap *gap;         /* level_gap.h; NULL without that surface */
    void (*update)(struct sph *s); /* start of a stage: looks at the flow inside; NULL: no need */
    void *ctx;                     /* of eval and surface */
    struct openings *openings;
    bool own_u[6], own_p[6]; /* by side: this half of the flow outside is taken from inside, so that
                                blending leaves it alone */
    double drain;            /* m/s: outwards, added to the flow outside: see openings.h */
    double outflow[6];       /* m/s: the same by side: see level_gap.h */
    void (*look_inside)(
        struct sph *s);      /* in a stage, after the surface was detected; NULL: no need */
    struct overlap *watched; /* overlap.h; NULL without a partner */
    /* Pa: reference pressure added to the outer solution, which an incompressible partner knows up
     * to a constant only; 0 without a free surface. */
    double gauge;
    double R, weight; /* m, Pa: the support, and rho g R where rest_excess is added; else 0 */
    double level;     /* Pa: the smoothed part of it that SPH's own pressure gives; NAN: none yet */
    int n; /* buffer or transition particles at hand, and the flow outside at their places */
    int *who;
    double *x, *u, *p, *gu, *gp;
    double *phi, *gphi; /* with a surface outside: see zones_surface */
};

/* Widths of transition and buffer, m, from parameters alone. */
void zones_widths(const struct run *r, const struct sph_params *prm, double *transition,
                  double *buffer);
/* The outer box along axis a around a free zone, m: transition and buffer on either side, and what
 * makes it a whole number of particles. */
void zones_around(const struct run *r, const struct sph_params *prm, int a, double free[2][3],
                  double *from, double *to);
/* Width of the overlap with a partner along each axis, m: as given, else 1.25 R, and in the midst
 * of a flow without surface and solids what leaves fv four cells across. Collective over r->comm.
 */
void zones_overlap(const struct run *r, const struct sph_params *prm, double width[3]);
/* "(0, 0) to (1, 1)": corners of a box for messages; valid until the next call. */
const char *zones_extent(int dim, double box[2][3]);
/* The box that a partner leaves to SPH, i.e. the free zone less the overlap; zones_free_box: the
 * free zone; m. */
void zones_given_box(const struct run *r, const struct sph_params *prm, double lo[3], double hi[3]);
/* Width of fv's cells along axis a, m, 0: it has blocks; *lo: where the first of those begins, m:
 * of graded layers the equal ones. Collective over r->comm. */
double zones_cell(const struct run *r, int a, double *lo);
void zones_free_box(const struct run *r, const struct sph_params *prm, double lo[3], double hi[3]);
/* The part of that box, moved by `way', that is made of whole cells of the partner: there it
 * imposes them, and there its water ends. */
void zones_counted_box(const struct run *r, const struct sph_params *prm, const double way[3],
                       double lo[3], double hi[3]);
/* How far x is inside a side of the box from lo to hi, m; negative outside. */
static inline double zones_inside(const double lo[3], const double hi[3], int side, const double *x)
{
    return side % 2 ? hi[side / 2] - x[side / 2] : x[side / 2] - lo[side / 2];
}
/* Side of the region nearest to x; *below: depth of x below it, m. */
int zones_nearest(const struct zones *z, const double *x, double *below);
/* Adds to the velocity u, m/s, at x what brings the level back (level_gap.h), outwards through the
 * nearest open side. */
void zones_add_outflow(const struct zones *z, const double *x, double *u);
/* The axis along which gravity is strongest. */
int zones_upright(const struct sph *s);
/* Depth of x below the open sides of the region, m; negative outside. */
double zones_depth(const struct sph *s, const double *x);

/* Fraction of a particle that SPH counts where a partner counts the rest: the part of its square or
 * cube in the free zone. */
double zones_share(const struct sph *s, int i);

/* Sets the zone of every local particle by its depth; before the list is built. */
void zones_mark(struct sph *s);
/* How far the outer solution is imposed at a height phi over its surface, m: 1 in its water and up
 * to dx/2 above, then falling linearly to 0 at 3 dx, above which particles are free (spray,
 * drops). */
double zones_wet(const struct zones *z, double phi);
/* Sets phi and gphi of the listed particles alone. */
void zones_look_at_surface(struct zones *z, double t);
/* Sets u, p (and gradients), with a surface phi, of the particles z->who[0..n-1] at their positions
 * z->x, at time t, s. */
void zones_look(struct zones *z, double t, bool gradients);
/* Adds local particle i to that list; zones_room makes room for n. */
void zones_list(struct sph *s, int i);
void zones_room(struct zones *z, int n);

#endif
