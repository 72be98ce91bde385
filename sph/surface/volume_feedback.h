/* volume_feedback.h - volumes slowly follow the room that particles have: a correction of the drift
 * that div u alone leaves in the volumes under a free surface. For transport tvs and gravity, in
 * violent flow alone with ALE, without zones otherwise; else the functions do nothing.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "surface.h"

/* At a new list: decides whether volumes are to follow, and makes room for the locals. */
void volume_feedback_prepare(struct sph *s);
/* After surface_detect and the walls' integrals: turns the kernel sums in s->surface->less into
 * the rates of this step. */
void volume_feedback_find(struct sph *s);
/* Adds them to the rates of volume of a stage. */
void volume_feedback_add(struct sph *s);
/* At the start, after gradients, on all levels: scales volumes, momenta and masses at once of the
 * particles whose support meets a wall, so that what the first particles leave free beside walls is
 * filled and the level stays; not with ALE. Lists must be made again. false: nothing was done. */
bool volume_feedback_fill(struct sph *s);
