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
/* Averages over indices become those over volumes, where these differ. */
void flow_to_volume(struct fv *s, double *q);

#endif
