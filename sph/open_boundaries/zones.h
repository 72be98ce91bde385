/* zones.h - free, transition and buffer zones of a particle region inside a larger flow (Chiron
 * 2017, 6.2-6.3). The flow outside is known through a function of place and time: an exact solution
 * or the patch of a partner. Births and removals at the outer face: openings.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_ZONES_H
#define SPH_ZONES_H

#include "../sph.h"

/* u[n][dim] (m/s), p[n] (Pa) and their gradients gu[n][dim][3], gp[n][3] (NULL: not wanted) at
 * x[n][3], t. */
typedef void zones_eval(void *ctx, double t, int n, const double *x, double *u, double *p,
                        double *gu, double *gp);

/* Height over the surface outside (m, < 0: water) and its gradient gphi[n][3] (NULL: not wanted).
 */
typedef void zones_surface(void *ctx, double t, int n, const double *x, double *phi, double *gphi);

struct openings;
struct overlap;
struct level_gap;
struct zones {
    double transition, buffer; /* m: widths */
    double overlap;            /* m: of the rim of the free zone where a partner is free, too */
    zones_eval *eval;
    struct sph_eos {
        double rho0, c0, gamma;
    } eos;                  /* the particles', for a partner of constant density */
    zones_surface *surface; /* of the flow outside, which has a part of it; NULL: full of water */
    struct level_gap *gap;  /* level_gap.h; NULL without that surface */
    void (*update)(struct sph *s); /* start of a stage: looks at the flow inside; NULL: no need */
    void *ctx;                     /* borrowed */
    struct openings *openings;
    struct overlap *watched; /* overlap.h; NULL without a partner */
    double gauge; /* Pa: added to the pressure outside, which an incompressible partner knows up to
                     a constant; 0 without a free surface */
    double level; /* Pa: the smoothed part of it that SPH's own pressure gives; NAN: none yet */
    double blended; /* kg: mass that blending added on this rank since the start */
    int n; /* buffer or transition particles at hand, and the flow outside at their places */
    int capacity;
    int *who;
    double *x, *u, *p, *gu, *gp;
    double *phi, *gphi; /* with a surface outside: see zones_surface */
};

/* Zones if the region s->lo..hi has open sides, else NULL. */
struct zones *zones_create(struct sph *s);
void zones_free(struct zones **z);
/* Widths and box of the free zone from parameters alone (open sides: not s->periodic). */
void zones_widths(const struct run *r, const struct sph_params *prm, double *transition,
                  double *buffer);
double zones_overlap(const struct run *r, const struct sph_params *prm);
/* The box that partners leave to SPH: the free zone less the overlap. */
void zones_given_box(const struct run *r, const struct sph_params *prm, double lo[3], double hi[3]);
void zones_free_box(const struct run *r, const struct sph_params *prm, double lo[3], double hi[3]);
/* Depth of x below the open sides of the region, m: negative outside. */
double zones_depth(const struct sph *s, const double *x);

/* Part of a particle that is SPH's to count where a partner counts the rest: what of its square or
 * cube lies in the free zone. */
double zones_share(const struct sph *s, int i);

/* m^dim: what the free zone holds. Collective. */
double zones_water(const struct sph *s);

/* Zone of every local particle by its depth; before the list is built. */
void zones_mark(struct sph *s);
/* Start of a stage: buffer particles take u and p from outside at s->t; m = rho w. */
void zones_stage(struct sph *s);
/* After the gradients of a stage: buffer slopes from outside; transport shift near the open sides.
 */
void zones_slopes(struct sph *s);
/* kg: of all particles of the region. Collective. */
double zones_mass(const struct sph *s);
/* At an exchange with a partner: sets the gauge by the mass of the region under a surface, else
 * lets out what it gained. Collective. */
void zones_gauge(struct sph *s);
/* After the RK cycle: transition particles are blended with the outside [6.7-6.8]. */
void zones_blend(struct sph *s);
/* After the positions moved by dt: removals, face masses, births [6.13-6.14]. Collective. */
void zones_openings(struct sph *s, double dt);
/* How far the flow outside is to be imposed there: 1 in its water, 0 in its air, where particles
 * are free (spray, drops). */
double zones_wet(const struct zones *z, double phi);
/* Fills phi and gphi alone. */
void zones_look_at_surface(struct zones *z, double t);
/* Fills u, p (and gradients), with a surface phi, of z->who[0..n-1] at places z->x. */
void zones_look(struct zones *z, double t, bool gradients);
/* Adds local particle i to that list. */
void zones_list(struct sph *s, int i);
void zones_room(struct zones *z, int n);

void zones_save(struct sph *s, struct h5 *f);
bool zones_load(struct sph *s, struct h5 *f);

#endif
