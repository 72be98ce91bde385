/* steps.h - steps in time, and what they start from.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_STEPS_H
#define FV_STEPS_H

#include "../fv.h"

/* projection.c: u, U and p by dt; false: a solver did not converge. */
bool projection_step(struct fv *s, double dt);
void pressure_start(struct fv *s);
/* fv_step.c: one step towards t_stop, see program.step; d is filled when the state cannot be
 * trusted. */
double integrate(struct fv *s, double t_stop, struct diagnosis *d);
void measure(struct fv *s);

/* The fields that a step starts from, and their names: their number. */
enum { FV_RESTART_FIELDS = 40 };
int fv_restart_fields(const struct fv *s, double **f, const char **names);
/* fv_keep.c: a copy of the state, to take steps back. */
struct kept;
struct kept *kept_create(const struct fv *s);
void kept_free(struct kept **k);
void kept_take(struct kept *k, struct fv *s);
void kept_put_back(struct kept *k, struct fv *s);

#endif
