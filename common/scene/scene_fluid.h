/* scene_fluid.h - where the fluid of a scene is at the start, and on which side of its walls.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_FLUID_H
#define COMMON_SCENE_FLUID_H

#include "exact.h"
#include "scene.h"

/* Gravity without its part along periodic axes, m/s^2, which drives a flow and lets no pressure
 * rise; returns its size. */
double scene_still_gravity(const struct scene *s, double still[3]);
/* The axis that it mostly points along; -1: there is none. */
int scene_still_axis(const struct scene *s);
/* Height of x against that gravity, m; without gravity y, in 3D z. */
double scene_height(const struct scene *s, const double *x);
/* Least and largest height in the domain, m. */
void scene_heights(const struct scene *s, double *low, double *high);
bool scene_in_shape(const struct scene *s, const struct scene_shape *h, const double *x);
/* Whether a shape's water stands level from the start: below a level, or a box on the floor of the
 * domain whose upright faces are sides of the domain or faces of bodies. */
bool scene_is_level(const struct scene *s, const struct scene_shape *h);
/* m: height of the surface of such a shape. */
double scene_level(const struct scene *s, const struct scene_shape *h);
/* Whether a shape adds a velocity to that of the field. */
bool scene_shapes_move(const struct scene *s);
/* Box around a shape, m; infinite where it has no end, or where a file of triangles has it. */
void scene_shape_extent(const struct scene_shape *h, double lo[3], double hi[3]);
/* Faults and warnings of shapes that hold fluid at none of the places first + i h, 0 <= i < n, of
 * which grains a program has: no grain, and the water is not there. */
void scene_check_grains(const struct scene *s, const struct params *p, const double *first,
                        const double *h, const int *n, const char *grain, struct faults *f);
/* Whether the shapes, or the field, have fluid at x, walls or not; velocity[3] (NULL: not wanted):
 * what the shape adds to the field's. */
bool scene_is_fluid(const struct scene *s, const struct exact *e, const double *x,
                    double *velocity);
/* Whether walls that are closed lines and bodies leave room at x at the start. */
bool scene_is_room(const struct scene *s, const double *x);
/* The same of walls that are closed lines alone. */
bool scene_in_tanks(const struct scene *s, const double *x);
/* Gives polylines and bodies the sense they must have: a body has its fluid outside; a wall, where
 * fluid lies on one side alone, has it there. What was turned is marked in the scene. */
void scene_orient(struct scene *s);

#endif
