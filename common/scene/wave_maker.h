/* wave_maker.h - wave makers: bodies whose motion (kind = "waves") makes the waves of the group
 * waves. A piston moves along them (axis x, y or z), a flap turns about a horizontal axis through
 * the body's centre. Biesel's transfer functions: a stroke S at the still level makes waves of the
 * height
 *   piston  H/S = 4 sinh^2 kh/(sinh 2kh + 2kh),
 *   flap    H/S = 4 sinh kh (sinh kh + (cosh kl - cosh kh)/(k (h - l)))/(sinh 2kh + 2kh),
 * k the wave number, h the depth, l the height of the flap's axis over the floor. A piston that
 * makes regular waves moves with Madsen's second order (J. Geophys. Res. 76, 1971), which
 * suppresses free waves of twice the frequency. Seas are the sum of their components. A paddle
 * with the water on its other side, towards which the waves run, moves with them as they arrive and
 * so lets them pass: a tank may have one at either end.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "motion_files.h"
#include "scene_groups.h"

/* Whether some body makes waves. */
bool scene_has_wave_maker(const struct scene *s);
/* H/S for wave number k, 1/m, depth h, m, and height l of a flap's axis, m; l < 0: a piston. */
double wave_maker_ratio(double k, double h, double l);
/* Adds a fault where there are no waves to make, or the axis makes none. */
void wave_makers_check(const struct scene *s, const struct params *p, struct faults *f);
/* Turns these motions into rows of a file in memory, which `files' owns; after scene_check. */
void wave_makers_resolve(struct scene *s, struct motion_files *files);
/* Logs the strokes. */
void wave_makers_describe(const struct scene *s);

/* The geometry of a body with a motion of kind waves. */
struct wave_paddle {
    double per;   /* what moves (m, rad) over the displacement at the still level, m, signed */
    double hinge; /* m: of a flap's axis over the floor; a piston < 0 */
    /* m: coordinate along the waves of the face that the water touches, at the start. */
    double face;
    double side; /* 1: the water lies before the face along the waves; -1: behind it, so that the
                    waves run towards the paddle, which moves with them and takes them up */
    double middle[3]; /* m: a point on the vertical plane through the middle of the face along the
                         waves */
};
/* Sets *p from body b and its motion m. */
void wave_paddle_of(const struct scene *s, const struct scene_body *b, const struct scene_motion *m,
                    struct wave_paddle *p);
struct waves;
/* Fraction of the waves' amplitude that the paddle makes at time t, s: they grow from 0
 * (waves.start). */
double wave_maker_grown(const struct waves *w, double t);
