/* outflow.h - convective outflow: dw/dt + U dw/dn = 0 with the
 * mean velocity U of the domain's side, and pressure free, where vortices pass that a given
 * pressure would reflect. Under a free surface U is that of long waves more, sqrt(g H) (Orlanski
 * 1976, with a known speed), and the level is free. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OUTFLOW_H
#define FV_OUTFLOW_H

#include "../fv.h"

/* Velocities of the start, from inside. Nothing where no side is carried, as all that follow. */
void outflow_start(struct fv *s);
/* Under a surface, at the start: what comes in from outside is that of this state for good. */
void outflow_meet_level(struct fv *s);
/* Before a step: takes note of the flow inside. Collective, as the next. */
void outflow_begin(struct fv *s);
/* Velocity on the sides dt after outflow_begin, of as much net flux as the other sides leave. */
void outflow_set(struct fv *s, double dt);
/* That of a state that has been read or put back. */
void outflow_restore(struct fv *s);

#endif
