/* volume.h - the volume of a closed room, kept through the steps.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_VOLUME_H
#define SPH_VOLUME_H

struct sph;

/* At the start, of a fluid of this volume, m^dim. Collective, as all here. */
void volume_remember(struct sph *s, double volume);
/* Where levels have exchanged particles: what an exchange within the step has added, m^dim, on this
 * rank. */
void volume_change(struct sph *s, double by);
/* After the stages of every step. */
void volume_keep(struct sph *s);
/* Where levels have exchanged particles: what is kept from then on. */
void volume_renew(struct sph *s);

#endif
