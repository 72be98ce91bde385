/* paddles.h - bodies that make waves and take up those that come back (motion of kind waves with
 * absorb = true): a gauge of the level before each of them steers it. What it is to do stands in
 * common/scene/wave_absorber.h. All ranks hold all paddles and compute the same; all levels of
 * refinement share them. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PADDLES_H
#define SPH_PADDLES_H

#include "../sph.h"

struct h5;

/* Faults: particles too coarse for the gauge, jobs in which it is not read. */
void paddles_check(const struct run *r, const struct sph_params *prm, struct faults *f);
/* Says what comes back from each of them. */
void paddles_describe(const struct run *r, const struct sph_params *prm);
/* Of the bodies of s->walls; a finer level takes those of the coarser one. */
void paddles_create(struct sph *s);
void paddles_free(struct sph *s);
/* Reads the gauges and steers from s->t on, dt s the step that begins. Needs prim; collective. */
void paddles_steer(struct sph *s, double dt);
void paddles_save(const struct sph *s, struct h5 *f);
/* false: the file has none that fit. */
bool paddles_load(struct sph *s, struct h5 *f);

#endif
