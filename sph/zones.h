/* zones.h - free, transition and buffer zones of a particle region inside a larger flow, and the
 * openings of its outer face where particles are born and removed (Chiron 2017, 6.2-6.3).
 * The flow outside is known through a function of place and time: an exact solution or the patch
 * of a partner. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_ZONES_H
#define SPH_ZONES_H

#include "sph.h"

/* u[n][dim], p[n] (Pa) and their gradients gu[n][dim][3], gp[n][3] (NULL: not wanted) at x[n][3], t. */
typedef void zones_eval(void *ctx, double t, int n, const double *x, double *u, double *p, double *gu,
                        double *gp);

struct zones {
    double transition, buffer;  /* m: widths */
    double free_lo[3], free_hi[3];
    zones_eval *eval;
    void *ctx;                  /* borrowed */
    struct openings *openings;  /* faces of the outer box */
    /* Booked on this rank since the start, kg: what pair fluxes and resets changed. */
    double booked_buffer, booked_blend;
    double born_mass, gone_mass;
    int64_t born, gone, refused;
    int n;                      /* scratch: buffer (or transition) particles and their values */
    int capacity;
    int *who;
    double *x, *u, *p, *gu, *gp;
};

/* Zones if the region s->lo..hi is smaller than the domain, else NULL. */
struct zones *zones_create(struct sph *s);
void zones_free(struct zones **z);
/* Box of the free zone of a scene, without a state. */
void zones_free_box(const struct run *r, const struct sph_params *prm, double lo[3], double hi[3]);
enum sph_zone zones_of(const struct zones *z, const double *x, int dim);

/* Zone of every local particle by its place; before the list is built. */
void zones_mark(struct sph *s);
/* Start of a stage: buffer particles take u and p from outside at s->t; w stays, m = rho w. */
void zones_stage(struct sph *s);
/* After the gradients of a stage: buffer slopes from outside; transport shift near the outer face. */
void zones_slopes(struct sph *s);
/* After the RK cycle: transition particles are blended with the outside [6.7-6.8]. */
void zones_blend(struct sph *s);
/* After the positions moved by dt: deletion, face masses, births [6.13-6.14]. Collective. */
void zones_openings(struct sph *s, double dt);

#endif
