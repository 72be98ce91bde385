/* outflow.h - sides through which the flow leaves as it is carried: dw/dt + U dw/dn = 0 with the
 * side's mean velocity U, and pressure free, where vortices pass that a given pressure would
 * reflect. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OUTFLOW_H
#define FV_OUTFLOW_H

#include "../fv.h"

struct h5;

/* Velocities of the start, from inside. */
void outflow_start(struct fv *s);
/* Before a step: takes note of the flow inside. Collective, as the next. */
void outflow_begin(struct fv *s);
/* Velocity on the sides dt after outflow_begin, of as much net flux as the other sides leave. */
void outflow_set(struct fv *s, double dt);
void outflow_save(const struct fv *s, struct h5 *f);
bool outflow_load(struct fv *s, struct h5 *f);

#endif
