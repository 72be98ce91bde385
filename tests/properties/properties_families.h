/* properties_families.h - the kinds of random scenes. SPDX-License-Identifier: BSD-3-Clause */
#ifndef TESTS_PROPERTIES_FAMILIES_H
#define TESTS_PROPERTIES_FAMILIES_H

#include "properties.h"
#include "properties_random.h"

struct family {
    const char *name;
    double weight;
    void (*make)(struct scene *s, struct random *r);
};

extern const struct family sph_families[], fv_families[]; /* end with an empty name */

/* A box of n cells or particles of h, its corner a whole number of h from the origin. */
void make_box(struct scene *s, struct random *r, const int *n, const double *h);
/* A spacing of few binary digits: multiples of it are exact. */
double make_spacing(struct random *r);
void make_fluid(struct scene *s, struct random *r); /* rho, and nu from speed and length */
void make_sides(struct scene *s, struct random *r, const char *kind); /* all that do not repeat */
/* Flow along x between the sides of a box that repeats itself along it, `length' apart. */
void make_channel(struct scene *s, struct random *r, double length);
/* A standing wave of length L on water that is `depth' deep. */
void make_wave(struct scene *s, struct random *r, double depth, double L);
/* Gravity of magnitude g, in half of the scenes along -axis, else askew. */
void make_gravity(struct scene *s, struct random *r, double g, int axis);
void make_obstacle(struct outline *o, struct random *r, const double *centre, double radius);
/* Time for n steps of dt, of which the run costs seconds (s) each. */
void make_end(struct scene *s, struct random *r, double dt, double seconds);
/* A field of waves, of n cells each, in a periodic box; returns cells to the shortest wave. */
double make_waves(struct scene *s, struct random *r, int n, double h);

/* Whether the waves are still there at the end, to measure an error by. */
bool make_lasting(const struct scene *s);

/* Of particles: a box of so many, scales and gravity of a tank, when to end, and what else. */
void make_particles(struct scene *s, struct random *r, int nx, int ny, int nz);
void make_tank(struct scene *s, struct random *r);
void settle_particles(struct scene *s, struct random *r, int particles);

void make_floating(struct scene *s, struct random *r);
void make_solid(struct scene *s, struct random *r);

#endif
