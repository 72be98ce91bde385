/* local_steps.h - each level of refinement with a time step of its own. A level takes its step,
 * then the next finer one the several steps that fill it (two where sound bounds them, four where
 * viscosity does), and so on. Guards of the finer level interpolate the coarser one in time between
 * both ends of its step; guards of the coarser level continue by their own rates from the fields
 * they had at the start, and get new fields when all finer levels have come to its end.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_LOCAL_STEPS_H
#define SPH_LOCAL_STEPS_H

#include "extremes.h"

/* After integrate_prepare: takes all levels from s->t to t_end, with creations and removals of the
 * finer levels; most gets the extremes of the last stages. s: the coarsest. Collective. */
void local_steps_take(struct sph *s, double t_end, double most[LEVELS][EXTREMES]);
/* Sets the next step of the coarsest level from what was measured, and the skins of all levels. */
void local_steps_plan(struct sph *s);

#endif
