/* particles.h - arrays of the particles and where their rows keep what.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PARTICLES_H
#define SPH_PARTICLES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct sph;

enum sph_zone { ZONE_FREE, ZONE_TRANSITION, ZONE_BUFFER };
/* Bits of what a particle is where there are levels (refinement/refinement.h): its fields are those
 * of others; it has given birth; a guard too far from flow for its slopes to count; one whose
 * support its level does not fill; it flows, within R of the surface; it is one guard too many;
 * from bit ROLE_SOURCE on the finer of a guard's two sources. Restart files hold them: struct
 * program, meaning. */
enum sph_role {
    ROLE_GUARD = 1,
    ROLE_MOTHER = 2,
    ROLE_DEEP = 4,
    ROLE_EDGE = 8,
    ROLE_SURFACE = 16,
    ROLE_SURPLUS = 32,
    ROLE_SOURCE = 6
};
enum { PRIM = 8 }; /* doubles of a line of prim */

/* Particles of one size level. State and rates are rows of nstate doubles,
 *   x[dim], q[dim] = m u, w (volume), m (mass),
 * so that Runge-Kutta is one loop. Lines are what the pair loops load: 64-byte multiples, aligned;
 * row `capacity' of lines is the dummy that pads neighbour rows (far away, volume 0).
 *   prim  [8]:        x[dim] u[dim] w rho (2D: then p c)
 *   slope [8 | 16]:   grad rho [dim], grad u [dim][dim] (a: component, b: direction), u0 [dim]
 * Locals are 0 .. n-1, sorted by cell; ghosts (halo of other ranks, periodic images) n ..
 * n+nghost-1: only prim and slope exist for them. */
struct particles {
    int n, nghost, capacity;
    int nhalo;      /* ghosts, the first ones, that are particles of other ranks or images */
    int nstate;     /* 2 dim + 2 */
    int nslope;     /* 8 (2D) or 16 (3D) */
    double *y, *y0; /* [capacity][nstate] state, at t_n */
    double *rate;   /* [capacity+1][nstate] its time derivative; until then sums of the pairs */
    double *sum;    /* of rates, where the scheme in time needs one; particles_sum */
    int sum_capacity;
    double *prim;         /* [capacity+1][8] */
    double *slope;        /* [capacity+1][nslope] */
    int64_t *id;          /* [capacity] unique over all ranks */
    unsigned char *zone;  /* [capacity] enum sph_zone */
    unsigned short *role; /* [capacity] bits of enum sph_role, 0 without levels */
    double (*size)[2];    /* [capacity] R, m, and weight, where particles of one set differ in them;
                             ghosts too; NULL: they do not. refinement/mixed.h */
};

/* Places in a row of the state and in a line: x and u (q) come first. */
static inline int at_volume(int dim) { return 2 * dim; }
static inline int at_mass(int dim) { return 2 * dim + 1; } /* of a row: y, rate, .. */
static inline int at_rho(int dim) { return 2 * dim + 1; }  /* of a line: prim */

/* Row i of y, y0, sum or rate; lines i of prim and slope. */
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

/* Whether particle i takes its fields from others: no part of any sum over the fluid. */
static inline bool particles_is_guard(const struct particles *p, int i)
{
    return (p->role[i] & ROLE_GUARD) != 0;
}

void particles_create(struct particles *p, int dim, int capacity);
void particles_free(struct particles *p);
/* Each has an R and a weight of its own from now on; these are set. */
void particles_add_sizes(struct particles *p, double R);
/* Room for n + nghost = total lines; keeps everything. */
void particles_reserve(struct particles *p, int total);
/* One more particle at the end (ghosts must be gone); returns its index; the row y is the caller's.
 */
int particles_add(struct particles *p, int64_t id, enum sph_zone zone);
/* Room for sums of rates; contents are lost when capacity has grown. */
double *particles_sum(struct particles *p);
/* Copies particle `from' over `to' (state, id, zone, role; slope, which births look at). */
void particles_copy(struct particles *p, int to, int from);
/* Reorders state, id, zone, role: new i is old order[i]; n entries. slopes: these too. */
void particles_permute(struct particles *p, int n, const int *order, bool slopes);
void particles_set(struct sph *s, int i, const double *x, const double *u, double w, double rho);
/* prim of all locals from y (u = q/m, rho = m/w; 2D: p, c). */
void particles_lines(struct sph *s);
/* The same of the share `part' of the way from y0 to y. */
void particles_lines_between(struct sph *s, double part);

#endif
