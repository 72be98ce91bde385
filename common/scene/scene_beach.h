/* scene_beach.h - zones before closed sides that bring water to rest, as a beach does: waves that
 * run into one are absorbed. Velocities follow du/dt = -r u, r = r_0 chi^2, chi from 0 at the inner
 * edge to 1 at the side, r_0 two times the angular frequency of the waves: a rate, for a share of a
 * step would be a wall to them. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_BEACH_H
#define COMMON_SCENE_BEACH_H

#include "scene.h"

bool scene_has_beach(const struct scene *s);
/* 1/s: the rate r at a place. */
double scene_beach_rate(const struct scene *s, const double *x);
/* Share of the height that comes back of waves of k h over a beach of so many wave lengths, -:
 * linear theory of such zones. */
double beach_reflection(double kh, double lengths);
/* Faults: a beach without its period, along gravity, longer than the domain. */
void scene_beach_check(const struct scene *s, const struct params *p, struct faults *f);
/* Says in the log what each beach absorbs. */
void scene_beach_describe(const struct scene *s);

#endif
