/* scene_waves.h - zones before vertical closed sides in which the velocity relaxes,
 *   du/dt = -r (u - u_w),   r = r_0 chi^2,
 * chi from 0 at the inner edge to 1 at the side, r_0 twice the angular frequency of the waves (a
 * rate per time, not per step, since a fixed share per step would make the zone reflect like a
 * wall). Beach: u_w = 0, or the mean flow that goes through: incoming waves are absorbed. Wave:
 * u_w is the velocity of the waves of the group waves, so that the zone makes them and absorbs what
 * comes back. Closed sides behind the zones keep the volume of water, and the waves are made
 * without net transport; on a current: scene_currents.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../waves/waves.h"
#include "scene_groups.h"

/* Turns sides of kinds wave and beach into slip walls with a zone; before scene_check. */
void scene_waves_mark(struct scene *s);
/* Adds a fault for zones along gravity, longer than the domain or without a period, and for waves
 * that would break. Without one it sets waves.made and the lengths and periods of zones that follow
 * from the waves. */
void scene_waves_check(struct scene *s, const struct params *p, struct faults *f);
/* Whether some zone makes waves. */
bool scene_makes_waves(const struct scene *s);
/* Logs which waves are made, and what each zone reflects. */
void scene_waves_describe(const struct scene *s);
/* Warns if what fills the box lo[3], hi[3], m, stands in the water of a zone, whose waves are those
 * over the flat floor at waves.depth. Returns whether it did. */
bool scene_waves_stands(const struct scene *s, const char *what, const double lo[3],
                        const double hi[3]);
/* Logs how many points ("cells", "particles"), h[3] m apart along the axes, a wave has along its
 * length and over its height, and warns below least[0] and least[1] of them. */
void scene_waves_resolution(const struct scene *s, const char *points, const double *h,
                            const double *least);
/* Still level of the waves, m against gravity: the highest of the shapes' levels and boxes, or
 * initial.level; NAN: none. */
double scene_waves_level(const struct scene *s);
/* Depth of the water below that level, m: waves.depth, or down to the domain's floor; NAN without
 * gravity. */
double scene_waves_depth(const struct scene *s);
/* Unit vector d along which the waves run, and the horizontal unit vector across it (may be NULL;
 * zero in 2D). */
void scene_waves_direction(const struct scene *s, double *d, double *across);
/* The axis that a wall's side is normal to; *low: whether it is the lower side. */
int scene_zone_axis(const struct scene_wall *w, bool *low);
/* The box lo[3], hi[3], m, of the zone before a wall's side: as long as the zone along the axis
 * that is returned, and as wide as the domain. -1: no zone stands there. */
int scene_zone_box(const struct scene *s, const struct scene_wall *w, double lo[3], double hi[3]);
/* Least and largest place, m, along the waves' direction and across it, in the zones that make
 * waves, or in one of them (NULL: all); 0 without any. */
void scene_waves_window(const struct scene *s, const struct scene_wall *only, double window[2][2]);
/* What the group waves asks for, in the terms of waves.h, for all zones together. */
struct wave_spec scene_waves_spec(const struct scene *s);
