/* steps.h - steps in time, and what they start from.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_STEPS_H
#define FV_STEPS_H

#include "../fv.h"

/* projection.c: advances u, U and p by dt, s, with rk3 or bdf2; false: a solver did not converge.
 * Collective, as all here. */
bool projection_step(struct fv *s, double dt);
/* fv_step.c: finds the pressure that goes with the velocities of the start, by short steps from the
 * same state. */
void pressure_start(struct fv *s);
/* Water at rest is not in balance where its surface is not level, nor what shapes have set in
 * motion: sets p of the start to that which goes with its acceleration. Nothing for other water
 * that moves already. Collective. */
void pressure_meet_surface(struct fv *s);
/* fv_step.c: under a surface, what pushes the water at once, walls that begin to move, an inflow,
 * velocities of shapes, has done so: makes the velocities those that it leaves. */
void push_start(struct fv *s);
/* fv_step.c: one step towards t_stop, see program.step; d is filled when the state cannot be
 * trusted. */
double integrate(struct fv *s, double t_stop, struct diagnosis *d);
/* stages.c: measures s->max, from which the next step's size follows. */
void measure(struct fv *s);

/* fv_keep.c: lists the fields that a step starts from, with their names in restart files, which are
 * static, and returns their number. */
int fv_restart_fields(const struct fv *s, double **f, const char **names);
/* A number that a step starts from; one of the three pointers is given, to the state's own. */
struct kept_number {
    const char *name, *of; /* its name in a restart file; what it belongs to, for messages */
    double *real;
    int64_t *count;
    bool *flag;
};
/* Lists all of them as far as this run has them, and returns their number. Restart files and copies
 * of the state hold the same list, so that neither forgets one. */
int fv_restart_numbers(struct fv *s, struct kept_number *of);
/* The same of the surface's alone. */
int fv_surface_numbers(struct surface *f, struct kept_number *of);
/* The value of one of them, whatever its type. */
double kept_number_get(const struct kept_number *x);
/* Sets it in the state. */
void kept_number_set(const struct kept_number *x, double value);

/* fv_keep.c: room for a copy of the state in memory, to take steps back; owned by the caller
 * (FREE). */
struct kept;
struct kept *kept_create(const struct fv *s);
/* Copies the state: fields, numbers, the clock, maxima and totals. */
void kept_take(struct kept *k, struct fv *s);
/* Puts the copy back into the state. */
void kept_put_back(struct kept *k, struct fv *s);

#endif
