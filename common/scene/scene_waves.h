/* scene_waves.h - zones before upright closed sides in which velocities follow
 * du/dt = -r (u - u_w), r = r_0 chi^2, chi from 0 at the inner edge to 1 at the side, r_0 two times
 * the angular frequency of the waves (a rate, for a share of a step would be a wall to them).
 * Beach: u_w = 0, waves that run there are absorbed. Wave: u_w is that of the waves of the group
 * waves, which the zone makes and whatever comes back passes; with closed sides behind zones no
 * water comes in or gets lost, and the waves have no net transport.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_WAVES_H
#define COMMON_SCENE_WAVES_H

#include "../waves/waves.h"
#include "scene.h"

/* Makes slip walls with a zone of the kinds wave and beach; before scene_check. */
void scene_waves_mark(struct scene *s);
/* Faults: zones along gravity, longer than the domain, without a period; waves that break. */
void scene_waves_check(const struct scene *s, const struct params *p, struct faults *f);
/* Lengths and periods of zones that the waves give; after scene_check. */
void scene_waves_resolve(struct scene *s);
bool scene_makes_waves(const struct scene *s);
/* Says in the log what waves are made, and what comes back from each zone. */
void scene_waves_describe(const struct scene *s);
/* m, against gravity: of the highest water that a level or a box of the shapes tells; NAN: none. */
double scene_waves_level(const struct scene *s);
/* m: of the water over the domain's floor, or waves.depth. */
double scene_waves_depth(const struct scene *s);
/* Unit vectors: in which waves run, and horizontal across it; across may be NULL. */
void scene_waves_direction(const struct scene *s, double *d, double *across);
/* The axis of a wall's side; low: whether it is the lower one. */
int scene_zone_axis(const struct scene_wall *w, bool *low);
/* What the group waves asks for. */
struct wave_spec scene_waves_spec(const struct scene *s);

#endif
