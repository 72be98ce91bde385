/* held_inflow.h - inflows that bring in the water of the start, whatever stands inside: those that
 * are faster than their waves. Without such inflows, or without a surface, the functions do
 * nothing. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_HELD_INFLOW_H
#define FV_HELD_INFLOW_H

#include "../fv.h"

/* At the start of a run, once areas and waves of the openings are known: finds these inflows, for
 * the whole run. Collective. */
void held_choose(struct fv *s);
/* Before the stages of a step: how much of what comes in through each of their faces is water.
 * Collective. */
void held_measure(struct fv *s);

#endif
