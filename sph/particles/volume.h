/* volume.h - conserves the volume of a fluid that fills a closed room. Volumes follow div u0 of
 * each particle, whose sum drifts as the packing settles; after each step all volumes are scaled by
 * one factor.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

struct sph;

/* At the start: remembers the fluid's volume, m^dim, if the room is closed (no free surface, no
 * opening); otherwise nothing below does anything. Collective, as all here. */
void volume_remember(struct sph *s, double volume);
/* With levels: adds to the remembered volume what an exchange of particles within the step has
 * added on this rank, m^dim. */
void volume_change(struct sph *s, double by);
/* After the stages of every step: scales all volumes so that their sum is the remembered one. */
void volume_keep(struct sph *s);
/* After an exchange of particles at the end of a step: remembers the present sum instead. */
void volume_renew(struct sph *s);
