/* wave_maker.h - bodies whose motion (kind = "waves") makes the waves of the group waves: a piston
 * (axis x, y or z along them) or a flap (a rotation about a horizontal axis through the body's
 * centre). Biesel's transfer functions: a stroke S at the still level makes waves of the height
 *   piston  H/S = 4 sinh^2 kh/(sinh 2kh + 2kh),
 *   flap    H/S = 4 sinh kh (sinh kh + (cosh kl - cosh kh)/(k (h - l)))/(sinh 2kh + 2kh),
 * l the height of its axis over the floor. Regular waves of a piston: with Madsen's second order
 * (J. Geophys. Res. 76, 1971), which keeps free waves of twice the frequency away. Seas: the sum of
 * their components. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_MAKER_H
#define COMMON_WAVE_MAKER_H

#include "motion_files.h"
#include "scene.h"

/* Whether some body does. */
bool scene_has_wave_maker(const struct scene *s);
/* H/S, l < 0: a piston. */
double wave_maker_ratio(double k, double h, double l);
/* Faults: no waves, an axis that makes none. */
void wave_makers_check(const struct scene *s, const struct params *p, struct faults *f);
/* Makes the motions rows of files, which belong to `files'; after scene_check. */
void wave_makers_resolve(struct scene *s, struct motion_files *files);
void wave_makers_describe(const struct scene *s);

/* What a motion of kind waves makes of its body. */
struct wave_paddle {
    double per;       /* what moves (m, rad) over the displacement at the still level, m, signed */
    double hinge;     /* m: of a flap's axis over the floor; a piston < 0 */
    double face;      /* m: along the waves, of the face that the water is at, at the start */
    double middle[3]; /* m: a point across the waves in the middle of the face */
};
void wave_paddle_of(const struct scene *s, const struct scene_body *b, const struct scene_motion *m,
                    struct wave_paddle *p);
struct waves;
/* Share of the waves that the paddle makes at t: they grow from nothing (waves.start). */
double wave_maker_grown(const struct waves *w, double t);

#endif
