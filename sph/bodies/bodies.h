/* bodies.h - free bodies within a run: their part of a stage, what limits their step, what they
 * show. A stage: places of the bodies, rates of the fluid, forces on the bodies, their rates; then
 * fluid and bodies go on with the same weights. All ranks hold all bodies and compute the same.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODIES_H
#define SPH_BODIES_H

#include "../walls/walls.h"

struct h5;

/* What the fluid's impedance, contact and lines need to know of the walls at the start. */
void bodies_create(struct sph *s);
/* A step begins; after the rates of a stage; then on by y = y0 + ahead * rate, having added weight
 * * rate to the sum, or at the last stage by y = y0 + sum; after the step. Stage and finish are
 * collective. */
void bodies_begin(struct sph *s);
void bodies_stage(struct sph *s, double weight);
void bodies_advance(struct sph *s, double ahead, double weight, bool last);
void bodies_finish(struct sph *s, struct diagnosis *d);
/* Largest step, s: dt <= 2/lambda, lambda the rate at which the sound that a body sends out stops
 * it (2.785 on the real axis of Runge-Kutta schemes); INFINITY without free bodies. */
double bodies_dt(const struct sph *s);

/* body_lines.c */
int body_line_other(const struct scene *c, const struct scene_line *l); /* -1: fixed in space */
void body_lines_slack(struct body *b);
void body_lines_add(const struct scene *c, struct body *bodies, int k, double (*loads)[6]);
double body_lines_energy(const struct scene *c, const struct body *bodies, int k);
/* Adds factor F at a place, and its moment about the centre, to what loads a body. */
void body_load(const struct body *b, const double *at, const double *F, double factor,
               double load[6]);

/* body_contact.c: forces between free bodies and what they touch. What is nearer at the start than
 * contact holds rests there. */
void body_contacts_start(struct sph *s);
/* m: how deep a contact without damping lets in what comes at v, m/s, in steps of dt, s. */
double body_contact_depth(double v, double dt);
void body_contacts_add(struct sph *s, double (*loads)[6]);

/* body_average.c: force on body k from the pressure on its surface, at each point the kernel
 * average of what the particles around would have there in a fluid that goes with it: the second
 * opinion. (What the walls' terms of the particles add up to is 1.39 times a constant pressure.)
 * Needs prim and slope. Collective. */
struct force body_average(struct sph *s, int k);
/* The same with what pushes on it, |p| times area, N, of the axis where that is largest, half of
 * both sides; and the mean of |p|, Pa. */
struct force body_average_pushed(struct sph *s, int k, double *pushed, double *pressure);
/* Of the reference of the pressure alone, which the particles leave out, on what the domain and
 * other walls leave wet of the surface: nothing, or the weight of what the body displaces, unless
 * they cut it. */
struct force body_reference(const struct sph *s, int k);

/* body_seal.c: adds to the forces of the stage what the water that seeps between a free body and
 * what it has rested on since the start pushes them apart with. Needs prim and slope.
 * Collective. */
void body_seals_add(struct sph *s);

/* body_output.c */
int bodies_columns(const struct run *r, int k, const char **names);
double *bodies_row(const struct sph *s, int k, double *values);
void bodies_summarise(const struct sph *s);
void bodies_save(const struct sph *s, struct h5 *f);
bool bodies_load(struct sph *s, struct h5 *f);

#endif
