/* outflow.h - sides through which the flow leaves as it is carried: dw/dt + U dw/dn = 0 with the
 * side's mean velocity U, and pressure free, where vortices pass that a given pressure would
 * reflect. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OUTFLOW_H
#define FV_OUTFLOW_H

#include "fv.h"

struct h5;

struct outflow {
    int side;            /* as in bc.h */
    int64_t n;           /* places on this rank */
    int64_t *place;      /* in the side's arrays */
    int64_t *cell;       /* inside */
    bool *own;           /* its face is one of this rank's, once */
    double *line[3];     /* [3 n]: the step's first velocity inwards, w + b x + c x^2, x in cells */
    double *change[3];   /* [places of the side] m/s: of w at the last outflow_set */
    double carried, sum; /* cells a second; m^dim/s outwards on this rank */
};

/* Velocities of the start, from inside. */
void outflow_start(struct fv *s);
/* Before a step: takes note of the flow inside. Collective, as the next. */
void outflow_begin(struct fv *s);
/* Velocity on the sides dt after outflow_begin, of as much net flux as the other sides leave. */
void outflow_set(struct fv *s, double dt);
void outflow_save(const struct fv *s, struct h5 *f);
bool outflow_load(struct fv *s, struct h5 *f);
void outflow_free(struct outflow **o);

#endif
