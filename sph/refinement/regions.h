/* regions.h - where particles are refined. Level n >= 1 has dx/2^n in its region B_n, a signed
 * distance d_n: guards where 0 < d_n < R_(n-1), refined particles deeper (Chiron 2017, 5.3).
 * B_n holds all of B_(n+1), apr.margin R_(n-1) and at least R_(n-1) + R_n within its edge.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_REGIONS_H
#define SPH_REGIONS_H

#include "../sph.h"

struct regions;

/* The regions of group apr; NULL: the case refines nothing. r is borrowed. Owned by the caller
 * (FREE). Every rank holds all regions in the same state. */
struct regions *regions_create(const struct run *r, const struct sph_params *prm);
/* Number of the finest level, >= 1. */
int regions_levels(const struct regions *g);
/* Signed distance of x to the edge of B_level, m, positive inside, 1 <= level, at the time of the
 * last regions_move. Parts of the edge on or beyond a wall, an end of the domain or the partner of
 * a periodic side do not count. It never exceeds the true distance; INFINITY: there is no edge,
 * -INFINITY: no region. */
double regions_distance(const struct regions *g, int level, const double *x);
/* Once a step, after the positions of bodies and the peak were set: moves the regions to time t, s.
 * Those that follow something move by half a spacing of their finest level per call at most. */
void regions_move(struct regions *g, double t);
/* Largest step, s, in which no prescribed region moves by more than half a spacing of its finest
 * level. INFINITY: none moves as prescribed. */
double regions_dt(const struct regions *g);
/* The same for the steps of one level, where regions of the next finer one are moved after each: by
 * half of its spacing. */
double regions_dt_outside(const struct regions *g, int level);
/* Sets where a body of the scene is, the same on all ranks; at the start all are where the case has
 * them. */
void regions_set_body(struct regions *g, int body, const struct body_motion *now);
/* Sets how far sph.box has moved: regions that follow it, and the cells of criteria, move with
 * it. */
void regions_set_box(struct regions *g, const double way[3]);
/* Whether level 1 comes within R of the zones at an open side; x: where, m. */
bool regions_meet_zones(const struct regions *g, int side, double x[3]);
/* Whether some region follows the peak, so that the position, m, and value, Pa, of the largest
 * pressure must be set. */
bool regions_want_peak(const struct regions *g);
void regions_set_peak(struct regions *g, const double *x, double p);

/* All that a restart needs, written or read; false: the file has none, or others. Collective. */
bool regions_restart(struct regions *g, struct h5 *f);

#endif
