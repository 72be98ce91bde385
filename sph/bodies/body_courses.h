/* body_courses.h - bodies that another program of the job moves (motion of kind partner): where
 * they are in the coupling step under way, as polynomials in time. All ranks hold all of them; all
 * levels of refinement share them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_COURSES_H
#define SPH_BODY_COURSES_H

#include "../../common/scene/scene.h"
#include "../sph.h"

struct h5;

/* Makes those of the bodies of s->walls, at rest where the case has them; a finer level shares
 * those of the coarser one. They belong to the walls. */
void body_courses_create(struct sph *s);
/* Lets the degrees of freedom go from where they are at t0 to to[0..n-1], m and rad, with the
 * velocities to[n..2n-1], at t1, s: a cubic in each, so that nothing jumps. */
void body_course_set(struct body_course *c, double t0, double t1, const double *to);
/* Restart files, written or read; false: the file has none that fit. */
bool body_courses_restart(struct sph *s, struct h5 *f);

#endif
