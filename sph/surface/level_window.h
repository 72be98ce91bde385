/* level_window.h - the inside of a body of water over its ground and below its level: what a gauge
 * measures there of the section that particles fill is free of what ground and surface do to them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_LEVEL_WINDOW_H
#define SPH_LEVEL_WINDOW_H

#include <math.h>
#include <stdbool.h>

/* Heights of its edges, which are ramps 2 dx wide, m: sums over a lattice are exact. */
struct level_window {
    double low, high, dx;
};

static inline struct level_window level_window(double ground, double level, double dx)
{
    return (struct level_window){ground + dx, level - 2.5 * dx, dx};
}

/* Whether water is deep enough for it: 5.5 dx. */
static inline bool level_window_fits(const struct level_window *w)
{
    return w->high - w->low >= 2.0 * w->dx;
}

/* 0 below height h, 1 above it. */
static inline double level_window_ramp(double z, double h, double dx)
{
    return fmax(0.0, fmin(1.0, 0.5 + 0.5 * (z - h) / dx));
}

/* Share of a volume at height z that lies above, and of what does not that lies inside. */
static inline double level_window_above(const struct level_window *w, double z)
{
    return level_window_ramp(z, w->high, w->dx);
}

static inline double level_window_inside(const struct level_window *w, double z, double above)
{
    return (1.0 - above) * level_window_ramp(z, w->low, w->dx);
}

/* filled: section that particles fill over that of the room; air or a cavity is no water. */
static inline bool level_window_is_water(double filled) { return fabs(filled - 1.0) < 0.15; }

#endif
