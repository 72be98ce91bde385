/* flow_measures.h - what outputs ask of a flow, on any cells. Velocities are those of the present
 * state, with ghosts.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FLOW_MEASURES_H
#define FV_FLOW_MEASURES_H

#include "../fv.h"

/* Sets w to dv/dx - du/dy in the cells of this rank, 1/s. */
void flow_vorticity(struct fv *s, double *w);
/* |curl u|^2 of the cell at place c of a part, 1/s^2. */
double flow_curl_squared(const struct fv *s, const struct part *p, int64_t c);
/* Largest divergence of the fluxes U in a computed cell, 1/s, over all ranks: what the projection
 * left. Collective. */
double flow_largest_divergence(struct fv *s);
/* flow_forces.c: number of bodies whose forces are reported apart: boxes that are cut out, or
 * blocks. */
enum { FLOW_BODIES_MAX = 16 };
int flow_bodies(const struct fv_params *prm);
/* Forces on each body and, in all, on all closed sides and bodies, N (2D: N/m); on blocks the
 * fourth component is the moment along z about the block's centre, N m. body NULL: not wanted.
 * Collective. */
void flow_forces(struct fv *s, double (*body)[4], double all[4]);
/* Power that comes in through this rank's sides, over rho, m^(dim+2)/s^3: energy, work of pressure
 * and of friction. */
double flow_power(struct fv *s);
/* flow_measures.c: turns averages over indices into averages over volumes, where these differ. */
void flow_to_volume(struct fv *s, double *q);

#endif
