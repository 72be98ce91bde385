/* flow_measures.h - what outputs ask of a flow, on any cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FLOW_MEASURES_H
#define FV_FLOW_MEASURES_H

#include "../fv.h"

/* dv/dx - du/dy in the cells of this rank, 1/s. */
void flow_vorticity(struct fv *s, double *w);
/* |curl u|^2 of the cell at place c of a part, 1/s^2. */
double flow_curl_squared(const struct fv *s, const struct part *p, int64_t c);
/* Largest divergence of the fluxes in a computed cell, 1/s, over all ranks: what the projection
 * left. */
double flow_largest_divergence(struct fv *s);
/* flow_forces.c: bodies, whose walls are counted apart: boxes that are cut out, or all blocks. */
enum { FLOW_BODIES_MAX = 16 };
int flow_bodies(const struct fv_params *prm);
/* Forces on each of them and on all closed sides and bodies, N (per metre in 2D); of blocks the
 * fourth is the moment along z about the block's centre, Nm. body NULL: not wanted. Collective. */
void flow_forces(struct fv *s, double (*body)[4], double all[4]);
/* What comes in through this rank's sides: energy, work of pressure and of friction, over rho. */
double flow_power(struct fv *s);
/* flow_measures.c: averages over indices become those over volumes, where these differ. */
void flow_to_volume(struct fv *s, double *q);

#endif
