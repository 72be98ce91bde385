/* outflow.h - convective outflow, dw/dt + U dw/dn = 0 with the mean velocity U of the domain's
 * side, and pressure free: vortices pass that a given pressure would reflect. Under a free surface
 * U is larger by the speed of long waves, sqrt(g H) (Orlanski, J. Comput. Phys. 21, 1976, with a
 * known speed), and the level is free. Without such sides the functions do nothing.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OUTFLOW_H
#define FV_OUTFLOW_H

#include "../fv.h"

/* Takes the velocities of the start from inside. */
void outflow_start(struct fv *s);
/* Whether a discharge that the case gives moves the water at this time, on all ranks alike. */
bool outflow_pushes(const struct fv *s);
/* Under a surface, at the start: what comes in from outside has this state from now on. */
void outflow_meet_level(struct fv *s);
/* Before a step: keeps the flow inside. Collective, as outflow_set. */
void outflow_begin(struct fv *s);
/* Sets the velocity on the sides dt, s, after outflow_begin, with as much net flux as the other
 * sides leave. */
void outflow_set(struct fv *s, double dt);
/* Sets the velocity of a state that was read or restored. */
void outflow_restore(struct fv *s);

#endif
