/* level_window.h - the part of a body of water that is well above its ground and below its level.
 * How much of the section the particles fill there is free of the effects of ground and surface on
 * them.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <math.h>
#include <stdbool.h>

/* Heights of its two edges, m. They are ramps 2 dx wide, so that sums over a lattice are exact. */
struct level_window {
    double low, high, dx;
};

/* The window of water between its ground and its level, m, in particles of spacing dx, m. */
static inline struct level_window level_window(double ground, double level, double dx)
{
    return (struct level_window){ground + dx, level - 2.5 * dx, dx};
}

/* Whether the water is deep enough for it: 5.5 dx. */
static inline bool level_window_fits(const struct level_window *w)
{
    return w->high - w->low >= 2.0 * w->dx;
}

/* 0 below the height h, 1 above it, linear over 2 dx. */
static inline double level_window_ramp(double z, double h, double dx)
{
    return fmax(0.0, fmin(1.0, 0.5 + 0.5 * (z - h) / dx));
}

/* Fraction of a volume at height z, m, that lies above the window. */
static inline double level_window_above(const struct level_window *w, double z)
{
    return level_window_ramp(z, w->high, w->dx);
}

/* Fraction of it that lies inside, given the fraction above. */
static inline double level_window_inside(const struct level_window *w, double z, double above)
{
    return (1.0 - above) * level_window_ramp(z, w->low, w->dx);
}

/* filled: section that particles fill over that of the room. Whether this is water, not air or a
 * cavity. */
static inline bool level_window_is_water(double filled) { return fabs(filled - 1.0) < 0.15; }
