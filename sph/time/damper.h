/* damper.h - the divergence that the acoustic damper of the Riemann schemes sees.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_DAMPER_H
#define SPH_DAMPER_H

struct sph;

/* After the first pass over pairs: puts the false divergence of each particle where pairs find it,
 * and near a free surface takes the divergence out of the gradients of u. Nothing without a damper.
 */
void damper_correct(struct sph *s);
/* With the rates of the last stage of a step of dt seconds: compares the trace of the gradients of
 * u with the rate at which the density of each particle really changes, and keeps the slow part of
 * the difference as its false divergence, 1/s. Nothing without a damper. */
void damper_learn(struct sph *s, double dt);

#endif
