/* scene_speed.h - what a scene lets expect of its velocities, before anything is computed: the
 * scale of sound speeds, of steps and of limits. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_SPEED_H
#define COMMON_SCENE_SPEED_H

#include "scene.h"

struct scene_speed {
    double speed;     /* m/s: largest to expect, > 0 */
    double pressure;  /* m^2/s^2: largest static p/rho: hydrostatic, or given at an outflow */
    double viscous;   /* m^2/s^2: largest p/rho that friction makes in slow flow */
    const char *from; /* what sets the speed: "the fall of the water" */
    bool moves;       /* false: nothing in the scene moves; the speed is sqrt(pressure), or the
                         domain's length over the run's time */
};

/* Of the initial field with what carries it, velocities of shapes, inflows (and what they make of a
 * narrower outlet), moving walls, bodies, the fall of the water: sqrt(2 g H) from its highest point
 * to the domain's lowest, of wave crests to the troughs, none where all water lies below one level;
 * body forces along periodic axes and pressure differences of openings, as far as run time,
 * viscosity and Bernoulli's equation let them. file: largest speed of bodies that follow a motion
 * file, m/s; 0: none. spacing: the least length that a run resolves, m, which bounds pressures in
 * corners; 0: not known. */
struct scene_speed scene_speed_of(const struct scene *s, double file, double spacing);

/* m, against gravity: highest water of the shapes; - infinity: without gravity or shapes. */
double scene_water_top(const struct scene *s);
/* Its speed alone, m/s; motion files count as rest. */
double scene_reference_speed(const struct scene *s);

#endif
