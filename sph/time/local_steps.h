/* local_steps.h - each level of refinement with a step of its own. A level takes its step, then the
 * next finer one several that fill it (two where sound bounds them, four where viscosity does),
 * and so on. Guards of the finer level take from the coarser one what flows there at their time,
 * between both ends of its step; guards of the coarser level go on from what they were given at
 * the start by their own rates, and are given fields anew when all finer levels have come to its
 * end. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_LOCAL_STEPS_H
#define SPH_LOCAL_STEPS_H

#include "extremes.h"

/* After integrate_prepare: all levels from s->t to t_end, births and removals of the finer levels
 * included; most gets what the last stages show. s: the coarsest. Collective. */
void local_steps_take(struct sph *s, double t_end, double most[LEVELS][EXTREMES]);
/* The step of the coarsest level that goes with what was measured, skins of all. */
void local_steps_plan(struct sph *s);

#endif
