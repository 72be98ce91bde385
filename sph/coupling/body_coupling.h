/* body_coupling.h - bodies in a coupled job: what the fluid does to them goes to any program that
 * asks for it, and a program may move them (motion of kind partner). Fields of one point at the
 * origin each, of body b: sph.b.force, sph.b.motion out, b.motion in; of one that bends, on the
 * points of its outline: sph.b.load out, b.outline in; coupler/README.md has their components.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_COUPLING_H
#define SPH_BODY_COUPLING_H

#include "../sph.h"

struct h5;

/* false, and said why: a partner is to move a body, and no other program takes part in the job. */
bool body_coupling_possible(const struct run *r);
/* Declares sets and fields. Collective. */
void body_coupling_create(struct sph *s);
/* s: the longest coupling step where no flow is shared: one step of sph, for a partner that answers
 * to a force later than that needs a body heavier than the water that sound reaches meanwhile. */
double body_coupling_window(const struct sph *s);
/* Before the first and after the last step of the coupling step [t0, t1], s: takes motions, puts
 * mean forces. Collective. */
void body_coupling_begin(struct sph *s, double t0, double t1);
void body_coupling_end(struct sph *s, double t1);

#endif
