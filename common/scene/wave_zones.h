/* wave_zones.h - the zones of scene_waves.h at work. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_ZONES_H
#define COMMON_WAVE_ZONES_H

#include "../files/h5.h"
#include "scene.h"

/* The zones of a resolved scene, made for one program; NULL: there are none. Free after use. */
struct wave_zones *wave_zones_create(const struct scene *s);
void wave_zones_free(struct wave_zones **z);
/* Makes ready for the time t, s. */
void wave_zones_at(struct wave_zones *z, double t);
/* 1/s: the rate r at x[3], and u_w[3], m/s. */
double wave_zones_rate(const struct wave_zones *z, const double *x, double *u_w);
/* What restart files hold of waves that evolve; collective. writes: on one rank. */
void wave_zones_save(const struct wave_zones *z, struct h5 *f, bool writes);
void wave_zones_load(struct wave_zones *z, struct h5 *f);
/* Whether some zone makes waves, which is work done on the water. */
bool wave_zones_drive(const struct wave_zones *z);

#endif
