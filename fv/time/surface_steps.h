/* surface_steps.h - the free surface at the start and around a step of the velocity;
 * surface_steps.c says in which order things move. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_SURFACE_STEPS_H
#define FV_SURFACE_STEPS_H

#include "../fv.h"

/* Makes velocities, fluxes and cuts at the start. Collective, as all but surface_trouble. */
void surface_start(struct fv *s);
/* After other cells have become imposed: adjusts the volume, `before', m^dim, being that in the
 * free ones before. Collective. */
void surface_interface_moved(struct fv *s, double before);
/* Extends the velocity beyond the present surface, with ghosts, and sets the fluxes there. */
void surface_extend(struct fv *s, int layers);
/* Moves phi by the first half of a step of dt, s. phi and u alternate: phi moves by half a step
 * before u and by half a step after it (leapfrog), so that they oscillate without loss. */
void surface_first_half(struct fv *s, double dt);
/* Moves phi by the second half of the step, keeps its volume and makes it a distance again where
 * that is due. */
void surface_second_half(struct fv *s, double dt);
/* Keeps what a step starts from. */
void surface_keep_state(struct fv *s);
/* Returns to it where the step is taken back. */
void surface_back(struct fv *s);
/* Why the run cannot go on; NULL if it can. Static memory. */
const char *surface_trouble(const struct fv *s);

#endif
