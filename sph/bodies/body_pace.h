/* body_pace.h - how fast and how quickly bodies will move: the scale of sound speeds.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_PACE_H
#define SPH_BODY_PACE_H

#include "bodies.h"

/* The largest of all bodies. */
struct body_pace {
    /* m/s: of prescribed motion and of the water that it drives through gaps, fall, loads, springs
     */
    double speed;
    /* m^2/s^2: p/rho of the fluid that harmonic motion, loads and springs accelerate: that times
     * the length of a tank, or times half of the length of a body with fluid around. */
    double pressure;
    double rate; /* 1/s: of harmonic motion, and of springs that a body swings on */
};

/* A jump in what a body is told. */
struct body_jolt {
    const char *name; /* of the body, borrowed from the scene; NULL: no body jumps */
    double at;        /* s */
    double u, a;      /* m/s, m/s^2: by which the velocity, the acceleration of its centre jump */
};

/* The first jump of a prescribed motion at 0 or where a term begins or ends, before the time
 * `until', s, in fluid that has the velocity U at 0; free bodies are left out. */
struct body_jolt bodies_jolt(const struct scene *c, struct motion_files *files, const double U[3],
                             double until);
/* spacing, m, of the particles, which narrower gaps do not let through. */
struct body_pace bodies_pace(const struct scene *c, struct motion_files *files, double spacing);
/* m/s: the largest speed of a point of one body. */
double body_speed_of(const struct scene *c, const struct body *b);

#endif
