/* wave_absorber.h - active absorption: a piston or flap yields to the waves that come back to it. A
 * gauge before its face reads the level. What the level has beyond the waves that are made, with
 * the evanescent modes beside the moving paddle included, is taken for a wave that runs towards the
 * paddle. With the displacement X beyond that which makes the waves,
 *   dX/dt = V - r X,   dV/dt = (-g e - V)/T,   e = level - wanted - its slow mean.
 * Gain g and lag T are such that linear waves of the design period (that of the peak) are absorbed
 * completely: the gauge sees them earlier than the paddle by the time from one to the other, and
 * reads the evanescent modes, which T takes into account. r returns the paddle to its mean position
 * and the mean follows the level within some periods, so that nothing drifts. The gauge stands near
 * the paddle, for of waves with k d > pi/2, d its distance, more than their height comes back;
 * those are a few particles long.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

struct waves;

/* The controller's constants; its state X, V and mean level belongs to the caller. */
struct wave_absorber {
    int axis;         /* enum body_axis: the degree of freedom that moves */
    double per;       /* m or rad of it per metre of displacement at the still level, signed */
    double along[3];  /* unit vector in which the waves run */
    double at[3];     /* m: the gauge while the paddle is at its start, at the still level */
    double hinge;     /* m: of a flap's axis over the floor; a piston < 0 */
    double distance;  /* m: of the gauge from the face */
    double side;      /* -: 1, or -1 where the waves run towards the paddle (wave_maker.h) */
    double still;     /* m: height of the still level on the axis of gravity, upwards */
    double omega, k;  /* rad/s, 1/m: of the design wave */
    double depth, g;  /* m, m/s^2 */
    double made;      /* -: c, amplitude of the waves over that of the displacement */
    double beside;    /* -: b, level at the gauge due to evanescent modes over displacement */
    double gain, lag; /* 1/s, s: g, T; b and g have the sign of side, X counts along the waves */
    double rate, mean_rate; /* 1/s: r, and the rate at which the mean follows the level */
    struct waves *waves;    /* the waves that are made; owned */
};

/* The absorber of a motion of kind waves with absorb = true, its gauge `distance' m before the
 * face; owned by the caller (FREE). s must have been through wave_makers_resolve. */
struct wave_absorber *wave_absorber_create(const struct scene *s, const struct scene_body *b,
                                           const struct scene_motion *m, double distance);
/* Level over the still one, m, that the gauge would read at time t, s, if nothing came back, while
 * the paddle is displaced by X metres at the still level, of which `made' make the waves. */
double wave_absorber_wanted(struct wave_absorber *a, double t, double X, double made);
/* Reflection coefficient for linear waves of the angular frequency omega, rad/s: height that comes
 * back over height that arrives. */
double wave_absorber_returns(const struct wave_absorber *a, double omega);
