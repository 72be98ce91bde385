/* scene_fluid.h - where the fluid of a scene is at the start, which way is up, and on which side of
 * its walls the fluid lies. Functions of the scene alone, local to a rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "exact.h"
#include "scene_groups.h"

/* Whether gravity along axis a drives a flow and tilts nothing: along a period, and along a channel
 * whose slope leaning gravity gives, which has an inlet or an outlet under a free surface at one
 * end and no closed side at the other. Heights are across the bed then. */
bool scene_is_driven_along(const struct scene *s, int a);
/* The part of gravity that a hydrostatic pressure balances, m/s^2: without that along axes where it
 * drives a flow. Returns its magnitude. */
double scene_still_gravity(const struct scene *s, double still[3]);
/* The axis along which that gravity has its largest component, the last of equal ones; -1: it is
 * zero. */
int scene_still_axis(const struct scene *s);
/* Height of x against that gravity, m; where it is zero, y, in 3D z. */
double scene_height(const struct scene *s, const double *x);
/* Smallest and largest height in the domain, m. */
void scene_heights(const struct scene *s, double *low, double *high);
/* Whether `at', or beyond periodic sides its image in the domain, lies inside a shape; h must be an
 * element of s->shapes. */
bool scene_in_shape(const struct scene *s, const struct scene_shape *h, const double *at);
/* Bounds of what can have water, m: the domain, in 2D the one line that keeps all of it. */
void scene_basin(const struct scene *s, double lo[3], double hi[3]);
/* Whether a shape's water is at rest under gravity from the start, if that of the others is: all
 * below a level, or a box on the floor of the basin whose vertical faces are its sides, or, in 2D,
 * faces of bodies or of other boxes, on which it may stand, too. */
bool scene_is_level(const struct scene *s, const struct scene_shape *h);
/* Height of the free surface of such a shape, m. */
double scene_level(const struct scene *s, const struct scene_shape *h);
/* Whether a shape adds a velocity to that of the initial field. */
bool scene_shapes_move(const struct scene *s);
/* Bounding box of a shape, m; infinite where it has no end, or where a file of triangles describes
 * it. */
void scene_shape_extent(const struct scene_shape *h, double lo[3], double hi[3]);
/* For a program that samples the fluid at the points first + i h, 0 <= i < n, m: warns of a shape
 * that holds none of them and so gets no water, and adds a fault if none holds any. grain: what the
 * program has there ("particle", "cell centre"). Call on all ranks alike. */
void scene_check_grains(const struct scene *s, const struct params *p, const double *first,
                        const double *h, const int *n, const char *grain, struct faults *f);
/* Whether the shapes, or the field where there are none, put fluid at x, regardless of walls.
 * velocity[3] (may be NULL) is what the shape adds to the field's, m/s. */
bool scene_is_fluid(const struct scene *s, const struct exact *e, const double *x,
                    double *velocity);
/* Whether x is, at the start, outside of bodies and within the walls that are closed polylines. */
bool scene_is_room(const struct scene *s, const double *x);
/* The same of the walls alone. */
bool scene_in_tanks(const struct scene *s, const double *x);
/* Gives polylines the sense they must have, with the fluid on their left: a body has its fluid
 * outside, a wall where it actually is if that is one side only. What was turned is marked in the
 * scene. */
void scene_orient(struct scene *s);
