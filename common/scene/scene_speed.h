/* scene_speed.h - estimates the velocities of a scene before anything is computed: the scale of
 * sound speeds, time steps and limits.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

/* The estimate, and which part of the scene it comes from. */
struct scene_speed {
    double speed; /* m/s: largest to expect, > 0 */
    /* m/s: of what is kept streaming: by the velocity that carries the field, openings, moving
     * walls, bodies of given velocity, body forces along periodic axes; 0: nothing is. */
    double stream;
    double pressure; /* m^2/s^2: largest static p/rho: hydrostatic, or given at an outflow */
    double viscous;  /* m^2/s^2: largest p/rho that friction makes in slow flow */
    double pushed; /* m^2/s^2: largest p/rho that bodies make by their acceleration: the caller's */
    /* m: half of the longest wave of sound that stands in the fluid: its length between walls, half
     * of a period, twice its depth under a surface; 0: sound leaves it, or its depth is not known.
     */
    double across;
    double rate;      /* 1/s: of the quickest motion that the room must follow: the caller's */
    const char *from; /* what sets the speed: "the fall of the water" */
    /* false: nothing in the scene moves, and speed is sqrt(pressure), or the domain's length over
     * the run's time. */
    bool moves;
};

/* The largest of: the initial field with the velocity that carries it, velocities of shapes,
 * inflows (and what they make of a narrower outlet), moving walls, bodies, the fall of the water,
 * sqrt(2 g H) from its highest point to its basin's lowest (for waves from crest to trough, none
 * where all water lies below one level), and what body forces along periodic axes and pressure
 * differences of openings reach within the run, limited by viscosity and Bernoulli's equation.
 * file: largest speed of bodies that follow a motion file, m/s; 0: none. spacing: smallest length
 * that the run resolves, m, which bounds the pressure in corners; 0: not known. */
struct scene_speed scene_speed_of(const struct scene *s, double file, double spacing);

/* Height of the highest water of the shapes, m against gravity; -INFINITY without gravity or
 * shapes. */
double scene_water_top(const struct scene *s);
