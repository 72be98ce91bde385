/* bodies.h - free bodies within a run: their part of a stage, what limits their step, what they
 * report. A stage: positions of the bodies, rates of the fluid, forces on the bodies, their rates;
 * then fluid and bodies advance with the same weights. All ranks hold all bodies and compute the
 * same bits. s is the coarsest level.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODIES_H
#define SPH_BODIES_H

#include "../walls/sph_walls.h"

struct h5;

/* At the start: what the fluid's impedance, contact and lines need to know of the walls.
 * Collective. */
void bodies_create(struct sph *s);
/* The parts of a step. bodies_begin stores the state as y0. bodies_stage, after the rates of a
 * stage, sums all loads on the free bodies and computes their rates. bodies_advance adds weight
 * times the rate to the sum and sets y = y0 + ahead rate, or at the last stage y = y0 + sum.
 * bodies_finish, after the step, takes the impulses of particles that were put back and fills d
 * where a body cannot go on. Stage and finish are collective. */
void bodies_begin(struct sph *s);
void bodies_stage(struct sph *s, double weight);
void bodies_advance(struct sph *s, double ahead, double weight, bool last);
void bodies_finish(struct sph *s, struct diagnosis *d);
/* Largest step, s: 2/lambda, lambda being the rate at which the fluid's acoustic impedance brakes a
 * body (2.785 is the limit of RK4 on the real axis); INFINITY without free bodies. */
double bodies_dt(const struct sph *s);

/* body_lines.c: index of the body at the other end of a line; -1: it is fixed in space. */
int body_line_other(const struct scene *c, const struct scene_line *l);
/* What the force of a line of body b meets at the start, kg, in 2D per metre: the effective masses
 * of both its ends, one after the other, as springs in series; INFINITY: neither yields. *way: the
 * line's vector, m, from the body; 0 has no direction. */
double body_line_mass(const struct scene *c, const struct body *b, const struct scene_line *l,
                      double way[3]);
void body_lines_slack(struct body *b);
void body_lines_add(const struct scene *c, struct body *bodies, int k, double (*loads)[6]);
double body_lines_energy(const struct scene *c, const struct body *bodies, int k);
/* Adds factor F, N, at the point `at', m, and its moment about the centre to a body's load (force,
 * moment). */
void body_load(const struct body *b, const double *at, const double *F, double factor,
               double load[6]);

/* body_contact.c: forces between free bodies and what they touch. At the start: what is nearer than
 * the distance that contact keeps rests there. */
void body_contacts_start(struct sph *s);
/* m: how deep a contact without damping lets in what comes at v, m/s, in steps of dt, s. */
double body_contact_depth(double v, double dt);
/* Adds these forces to the loads of a stage; after the step: what friction has gathered. */
void body_contacts_add(struct sph *s, double (*loads)[6]);
void body_contacts_finish(struct sph *s);

/* body_average.c: an independent estimate of the force on body k, from the pressure on its surface:
 * at each point the kernel average of the pressure that the particles around would have there in a
 * fluid that moves with the body. (The sum of the particles' wall terms is 1.39 times a constant
 * pressure.) Needs prim and slope. Collective. */
struct force body_average(struct sph *s, int k);
/* The same, with *pushed = |p| times area, N, of the side along an axis that bears most of it, and
 * *pressure = the mean of |p|, Pa. */
struct force body_average_pushed(struct sph *s, int k, double *pushed, double *pressure);
/* The force of the pressure reference alone, which the particles leave out, on the part of the
 * surface that the domain and other walls leave wet: zero, or the weight of what the body
 * displaces, unless they cut it. Sets the reference loads of one that bends. */
struct force body_reference(const struct sph *s, int k);

/* body_wedge.c: finds where bodies that stay where they are leave too little room for particles
 * before each other and walls at rest. */
void body_wedges_find(struct sph *s);
/* body_seal.c: adds to the forces of the stage, before they are summed, the pressure of the water
 * that seeps between a free body and what it has rested on since the start, and of that in those
 * wedges. Needs prim and slope. Collective. */
void body_seals_add(struct sph *s);

/* body_output.c: adds the columns of body k, if it moves. */
void bodies_row(const struct sph *s, int k, struct figures *to);
void bodies_summarise(const struct sph *s);
/* Restart files, written or read; false: the file has none that fit. */
bool bodies_restart(struct sph *s, struct h5 *f);

#endif
