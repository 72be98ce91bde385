/* wave_absorber.h - pistons and flaps that take up what comes back to them (active absorption). A
 * gauge before the paddle's face reads the level. What it has beyond the waves that are made, the
 * evanescent modes beside the paddle that makes them included, runs towards the paddle, which
 * yields to it: with the displacement X beyond that which makes the waves,
 *   dX/dt = V - r X,   dV/dt = (-g e - V)/T,   e = level - wanted - its slow mean.
 * Gain g and lag T are such that linear waves of the design's (peak's) period do not come back at
 * all: the gauge sees them earlier than the paddle by the time from one to the other, and reads the
 * modes beside it, which T takes. r returns the paddle to its place and the mean follows the level
 * within some periods: nothing drifts. The gauge stands near, for of waves with k d > pi/2 more
 * than all comes back; those are a few particles long. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_ABSORBER_H
#define COMMON_WAVE_ABSORBER_H

#include "scene.h"

struct waves;

struct wave_absorber {
    int axis;         /* enum body_axis: what moves */
    double per;       /* of it (m, rad) a metre of displacement at the still level, with its sign */
    double along[3];  /* unit vector in which the waves run */
    double at[3];     /* m: place of the gauge while the paddle is at its start, at the level */
    double hinge;     /* m: of a flap's axis over the floor; a piston < 0 */
    double distance;  /* m: of the gauge from the face */
    double still;     /* m: height of the still level on the axis of gravity, upwards */
    double omega, k;  /* 1/s, 1/m: of the design */
    double depth, g;  /* m, m/s^2 */
    double made;      /* -: c, amplitude of the waves over that of the displacement */
    double beside;    /* -: b, level at the gauge over the displacement, evanescent modes */
    double gain, lag; /* 1/s, s: g, T */
    double rate, mean_rate; /* 1/s: r, and that of the mean */
    struct waves *waves;    /* owned */
};

/* The absorber of a motion of kind waves with absorb = true, its gauge that far before the face;
 * the caller's, to be freed with wave_absorber_free. s: after wave_makers_resolve. */
struct wave_absorber *wave_absorber_create(const struct scene *s, const struct scene_body *b,
                                           const struct scene_motion *m, double distance);
void wave_absorber_free(struct wave_absorber **a);
/* m over the still one: level that the gauge would read at t if nothing came back, the paddle being
 * displaced by X metres at the still level, of which `made' to make the waves. */
double wave_absorber_wanted(struct wave_absorber *a, double t, double X, double made);
/* Share of the height of linear waves of the angular frequency omega that comes back. */
double wave_absorber_returns(const struct wave_absorber *a, double omega);

#endif
