/* paddles.h - wave makers that absorb the waves which come back (motion of kind waves with absorb =
 * true): a gauge of the level before each of them controls its motion, by the law in
 * common/scene/wave_absorber.h. All ranks hold all paddles and compute the same; all levels of
 * refinement share them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PADDLES_H
#define SPH_PADDLES_H

#include "../sph.h"

struct h5;

/* Adds faults: particles too coarse for the gauge, jobs in which it is not read. */
void paddles_check(const struct run *r, const struct sph_params *prm, struct faults *f);
/* Logs how much each of them reflects. */
void paddles_describe(const struct run *r, const struct sph_params *prm);
/* Makes those of the bodies of s->walls; a finer level shares those of the coarser one.
 * They belong to the walls. */
void paddles_create(struct sph *s);
/* Reads the gauges at s->t and sets the motion from then on; dt, s: the step that begins. Needs
 * prim. Collective. */
void paddles_steer(struct sph *s, double dt);
/* Restart files, written or read; false: the file has none that fit. */
bool paddles_restart(struct sph *s, struct h5 *f);

#endif
