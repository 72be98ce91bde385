/* scene_beach.c - see scene_beach.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_beach.h"

#include <math.h>
#include <stdio.h>

#include "../base/log.h"
#include "../base/vec3.h"
#include "scene_fluid.h"

bool scene_has_beach(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < s->nwalls; k++)
        any = any || s->walls[k].beach > 0.0;
    return any;
}

static double omega(const struct scene_wall *w) { return 2.0 * M_PI / w->beach_period; }

double scene_beach_rate(const struct scene *s, const double *x)
{
    double rate = 0.0;
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        if (!(w->beach > 0.0))
            continue;
        const int axis = (w->side - SIDE_X_MIN) / 2;
        const bool low = (w->side - SIDE_X_MIN) % 2 == 0;
        const double from = low ? x[axis] - s->domain.min[axis] : s->domain.max[axis] - x[axis];
        const double chi = fmin(1.0, fmax(0.0, 1.0 - from / w->beach));
        rate = fmax(rate, 2.0 * omega(w) * chi * chi);
    }
    return rate;
}

enum { LENGTHS = 4, DEPTHS = 3 };

double beach_reflection(double kh, double lengths)
{
    static const double at[LENGTHS] = {0.5, 1.0, 1.5, 2.0}, depth[DEPTHS] = {0.5, 1.0, 3.0},
                        R[DEPTHS][LENGTHS] = {{0.21, 0.017, 0.005, 0.002},
                                              {0.18, 0.008, 0.003, 0.002},
                                              {0.14, 0.023, 0.005, 0.004}};
    const double z = fmin(fmax(kh, depth[0]), depth[DEPTHS - 1]);
    const int d = z < depth[1] ? 0 : 1;
    const double q = (z - depth[d]) / (depth[d + 1] - depth[d]);
    double line[LENGTHS];
    for (int k = 0; k < LENGTHS; k++)
        line[k] = (1.0 - q) * log(R[d][k]) + q * log(R[d + 1][k]);
    if (lengths <= at[0]) /* all of it without a beach */
        return exp(line[0] * fmax(lengths, 0.0) / at[0]);
    int k = 0;
    while (k < LENGTHS - 2 && lengths > at[k + 1])
        k++;
    const double t = fmin(1.0, (lengths - at[k]) / (at[k + 1] - at[k]));
    return exp((1.0 - t) * line[k] + t * line[k + 1]);
}

void scene_beach_check(const struct scene *s, const struct params *p, struct faults *f)
{
    const int up = scene_still_axis(s);
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        const int axis = (w->side - SIDE_X_MIN) / 2;
        char key[64];
        snprintf(key, sizeof key, "walls.[%d].beach", k);
        if ((w->beach > 0.0) != (w->beach_period > 0.0)) {
            params_fault(p, f, key,
                         "a beach needs its length and the period of the waves that it is to "
                         "absorb: give beach (m) and beach_period (s), or neither");
            continue;
        }
        if (!(w->beach > 0.0) || w->side == SIDE_NONE)
            continue;
        const double whole = s->domain.max[axis] - s->domain.min[axis];
        if (axis == up)
            params_fault(p, f, key,
                         "a beach is before an upright side, not below or above the water");
        else if (w->beach >= whole)
            params_fault(p, f, key, "%g m: the domain is %g m long there", w->beach, whole);
    }
}

/* 1/m: of waves of the angular frequency w, by Newton's method. */
static double wave_number(double w, double g, double h)
{
    double k = w * w * h / g > 1.0 ? w * w / g : w / sqrt(g * h);
    for (int n = 0; n < 12; n++) {
        const double t = tanh(k * h), r = g * k * t - w * w;
        k -= r / (g * t + g * k * h * (1.0 - t * t));
    }
    return k;
}

/* m, against gravity: of the highest water that a level or a box of the shapes tells; NAN: none. */
static double level_of(const struct scene *s)
{
    const int up = scene_still_axis(s);
    double level = NAN;
    for (int k = 0; k < s->nshapes && up >= 0; k++) {
        const struct scene_shape *is = s->shapes + k;
        const double top = s->fluid.gravity[up] < 0.0 ? is->box[1][up] : -is->box[0][up];
        if (!is->hole && is->form == SHAPE_BELOW)
            level = fmax(level, is->level);
        else if (!is->hole && is->form == SHAPE_BOX)
            level = fmax(level, top);
    }
    return scene_has_wave(s) && s->initial.level < LEVEL_TOP ? s->initial.level : level;
}

void scene_beach_describe(const struct scene *s)
{
    const int up = scene_still_axis(s);
    const double g = vec3_length(s->fluid.gravity);
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        if (!(w->beach > 0.0))
            continue;
        const char *side = scene_side_names[w->side - SIDE_X_MIN];
        const double floor = up < 0                       ? NAN
                             : s->fluid.gravity[up] < 0.0 ? s->domain.min[up]
                                                          : -s->domain.max[up],
                     h = level_of(s) - floor;
        if (!(h > 0.0)) {
            log_say("%s: beach over %g m, for waves of %g s", side, w->beach, w->beach_period);
            continue;
        }
        const double number = wave_number(omega(w), g, h), length = 2.0 * M_PI / number,
                     R = beach_reflection(number * h, w->beach / length);
        log_say("%s: beach over %g m, %.2g lengths of waves of %g s (%.3g m): %.2g %% of their "
                "height comes back",
                side, w->beach, w->beach / length, w->beach_period, length, 100.0 * R);
        if (w->beach < 0.8 * length)
            log_warn("%s: a beach shorter than a wave length reflects; give beach = %.3g, or %.2g "
                     "for a sea",
                     side, length, 1.5 * length);
    }
}
