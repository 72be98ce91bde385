/* wave_zones.h - evaluates the zones of scene_waves.h during a run.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../files/files.h"
#include "scene_groups.h"

/* The zones of a resolved scene; NULL: there are none. Owned by the caller (FREE). Each
 * rank makes its own. pass: the sides behind have the waves' own velocity, so that zones need not
 * make up for what a side takes off them (zone_gain.h). */
struct wave_zones *wave_zones_create(const struct scene *s, bool pass);
/* Prepares the waves for the time t, s; before wave_zones_rate. */
void wave_zones_at(struct wave_zones *z, double t);
/* The rate r, 1/s, at x[3], and the wanted velocity u_w[3], m/s, 0 outside of the zones. Where
 * zones overlap, rates add and u_w is their mean weighted by them. */
double wave_zones_rate(const struct wave_zones *z, const double *x, double *u_w);
/* Whether x[3], m, is in a zone. */
bool wave_zones_hold(const struct wave_zones *z, const double *x);
/* wave_zones_rate at n <= WAVE_COLUMN places, m, above each other: rate and, to rounding, the
 * velocities u_w, m/s. Several times as fast for tens of them. */
enum { WAVE_COLUMN = 64 };
double wave_zones_column(const struct wave_zones *z, int n, double (*x)[3], double (*u_w)[3]);
/* Writes the state of waves that evolve nonlinearly to a restart file, or reads it back; collective
 * over the file's communicator. */
void wave_zones_restart(struct wave_zones *z, struct h5 *f);
/* Whether some zone makes waves, i.e. does work on the water. */
bool wave_zones_drive(const struct wave_zones *z);
