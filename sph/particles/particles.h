/* particles.h - the arrays of the particles, and where their records keep what. State and rates are
 * records of nstate doubles, so that a Runge-Kutta stage is one loop; packed records ("lines") are
 * what the loops over pairs load.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct sph;

/* Where a particle is in a region with open sides: zones.h. */
enum sph_zone { ZONE_FREE, ZONE_TRANSITION, ZONE_BUFFER };
/* Bits of a particle's role where there are levels (refinement/refinement.h): it is a guard, whose
 * fields are interpolated from particles that flow; it is a parent, i.e. has created children; it
 * is a guard too far from the flow for its slopes to count; its level does not fill its support,
 * or, of what flows, guards do; it flows within R of the surface; it is a guard to be removed. Four
 * bits from ROLE_SOURCE on: the finer of a guard's two source levels. Four from ROLE_CORNER on:
 * where among its parent's children it was created, which is 8 + the bits of the axes along which
 * it stands on the upper side; 0: elsewhere. Restart files hold these bits: see `meaning' in struct
 * program. */
enum sph_role {
    ROLE_GUARD = 1,
    ROLE_PARENT = 2,
    ROLE_DEEP = 4,
    ROLE_EDGE = 8,
    ROLE_SURFACE = 16,
    ROLE_SURPLUS = 32,
    ROLE_SOURCE = 6,
    ROLE_CORNER = 10
};
enum { PRIM = 8, PULL = 4 }; /* doubles of a line of prim, of pull */
/* Where the false divergence (time/damper.h) is: in 2D in a line of prim, in 3D in one of slope. */
enum { PRIM_FALSE = 6, SLOPE_FALSE = 15 };

/* Particles of one size level. A record of the state (y, y0, rate, sum) is
 *   x[dim], q[dim] = m u, w (volume), m (mass).
 * Packed records are multiples of 64 bytes, aligned; record `capacity' is the dummy that pads
 * neighbour rows (far away, volume 0):
 *   prim  [8]:        x[dim] u[dim] w rho (2D: then the false divergence, and one that is free)
 *   slope [8 | 16]:   grad rho [dim], grad u [dim][dim] (a: component, b: direction), u0 [dim]
 *                     (3D: then the false divergence)
 * Locals are 0 .. n-1, sorted by cell; ghosts (halo of other ranks, periodic images, then ghosts of
 * walls and open sides) are n .. n+nghost-1 and have only prim and slope. All arrays are owned. */
struct particles {
    void *owner; /* of the arrays */
    int n, nghost, capacity;
    int nhalo;      /* ghosts, the first ones, that are particles of other ranks or images */
    int nstate;     /* 2 dim + 2 */
    int nslope;     /* 8 (2D) or 16 (3D) */
    double *y, *y0; /* [capacity][nstate] state, at t_n */
    /* [capacity+1][nstate] its time derivative; before that, sums of a symmetric pass. */
    double *rate;
    double *sum; /* [sum_capacity][nstate] weighted sum of rates, where the Runge-Kutta scheme needs
                    one */
    int sum_capacity;
    double *pull; /* [pull_capacity][PULL] 1/s, m/s: rate and velocity of zones, where some are */
    int pull_capacity;
    double *prim;    /* [capacity+1][8] packed primitive variables */
    double *slope;   /* [capacity+1][nslope] packed gradients and transport velocity */
    int64_t *id;     /* [capacity] unique over all ranks */
    int64_t next_id; /* of the next one created on this rank; goes up by the number of ranks */
    double *false_divergence; /* [capacity] 1/s: error of the trace of grad u; see time/damper.h */
    unsigned char *zone;      /* [capacity] enum sph_zone */
    unsigned short *role;     /* [capacity] bits of enum sph_role, 0 without levels */
    double (*size)[2]; /* [capacity] R, m, and weight, where particles of one set differ in them;
                          ghosts too; NULL: they do not. refinement/mixed.h */
};

/* Offsets within a record of the state and within prim; x and u (q) come first in both. */
static inline int at_volume(int dim) { return 2 * dim; }
static inline int at_mass(int dim) { return 2 * dim + 1; } /* of a row: y, rate, .. */
static inline int at_rho(int dim) { return 2 * dim + 1; }  /* of a line: prim */

/* The record of particle i in y, y0, sum or rate; in prim; in slope. Valid until the arrays
 * grow. */
static inline double *state_row(const struct particles *p, double *rows, int i)
{
    return rows + (ptrdiff_t)p->nstate * i;
}
static inline double *prim_line(const struct particles *p, int i)
{
    return p->prim + (ptrdiff_t)PRIM * i;
}
static inline double *slope_line(const struct particles *p, int i)
{
    return p->slope + (ptrdiff_t)p->nslope * i;
}

/* Takes the fraction `share' of the mass of particle i, with the momentum that it carries, out of
 * `rows': of the state y, or of the rates, for which share is per second. Velocity and volume stay.
 * Mass that was taken back without its momentum would slow a stream, so that the flow would depend
 * on the observer. */
static inline void particles_give_back(struct particles *p, double *rows, int i, double share)
{
    const double *y = state_row(p, p->y, i);
    double *row = state_row(p, rows, i);
    for (int k = p->nstate / 2 - 1; k < p->nstate; k++)
        row[k] -= k == p->nstate - 2 ? 0.0 : share * y[k];
}

/* Whether particle i is a guard, which takes part in no sum over the fluid. */
static inline bool particles_is_guard(const struct particles *p, int i)
{
    return (p->role[i] & ROLE_GUARD) != 0;
}

/* Whether the mass of particle i follows its exchange with others: not that of guards, nor in the
 * buffer before an open side, where the outer solution imposes it. */
static inline bool particles_keeps_mass(const struct particles *p, int i)
{
    return p->zone[i] != ZONE_BUFFER && !particles_is_guard(p, i);
}

/* Makes room for `capacity' particles in 2 or 3 dimensions; there are none yet. The
 * arrays belong to `owner'. The old contents of *p are not freed. */
void particles_create(void *owner, struct particles *p, int dim, int capacity);
/* Allocates size and sets it to R, m, and weight 1 for all locals. */
void particles_add_sizes(struct particles *p, double R);
/* Makes room for n + nghost = total records. Contents are kept, pointers into the arrays are
 * not. */
void particles_reserve(struct particles *p, int total);
/* Adds a particle at the end (there must be no ghosts) and returns its index; its state is 0, for
 * the caller to set. */
int particles_add(struct particles *p, int64_t id, enum sph_zone zone);
/* The array `sum', allocated for capacity records; its contents are lost when capacity has
 * grown. */
double *particles_sum(struct particles *p);
/* The array `pull', in the same way. */
double *particles_pull(struct particles *p);
/* Copies particle `from' over `to': state, id, zone, role, size and slope, which creations of
 * particles read. */
void particles_copy(struct particles *p, int to, int from);
/* Reorders state, id, zone, role and size of the locals: new i is old order[i]; n entries. slopes:
 * these too. Overwrites y0. */
void particles_permute(struct particles *p, int n, const int *order, bool slopes);
/* Sets the state of local i from position, m, velocity, m/s, volume, m^dim, and density, kg/m^3. */
void particles_set(struct sph *s, int i, const double *x, const double *u, double w, double rho);
/* What a particle at x, m, counts in sums over the fluid of all levels, 0 to 1: less than 1 where
 * two of them meet. */
double particles_share(const struct sph *s, const double *x);
/* Computes prim of all locals from y (u = q/m, rho = m/w; in 2D also p and c). */
void particles_lines(struct sph *s);
/* The same for the state y0 + part (y - y0). */
void particles_lines_between(struct sph *s, double part);
