/* wall_joint.h - points of the plane where walls touch and part the fluid: a flap that stands on
 * the floor, two bodies that lean on each other. The solid is thinner there than any support, so
 * that particles on either side would see each other, and the walls of the other side, through it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_JOINT_H
#define SPH_WALL_JOINT_H

#include "walls.h"

/* The part of a segment that bounds one of the fluids which a joint parts. */
struct joint_face {
    struct segment is; /* that part */
    int piece, fluid;  /* the segment; which fluid, from 0 */
    double from, to;   /* m along the segment */
};

enum { JOINT_FACES = 32 };

struct wall_joint {
    double x[2]; /* m */
    int nfaces, nfluids;
    struct joint_face face[JOINT_FACES];
};

struct wall_joints {
    int n, capacity;
    int nfixed; /* so many come first that nothing moves */
    bool known; /* these have been looked for */
    struct wall_joint *of;
};

/* Joints of the walls of a plane domain as they stand now; walls touch where they are nearer to
 * each other than dx/10. Faces are followed to 2 R from the joint. */
void wall_joints_find(const struct sph *s, struct wall_joints *to);
void wall_joints_free(struct wall_joints *to);
/* Which of its fluids holds x: the one whose faces are nearest, of those that x is before. */
int wall_joint_fluid(const struct wall_joint *j, const double *x);
/* Whether x and y lie in different fluids and walls of these stand between. */
bool wall_joint_hides(const struct wall_joint *j, const double *x, const double *y);
/* The part of a segment that bounds a fluid; NULL: none does. */
const struct joint_face *wall_joint_face(const struct wall_joint *j, int piece, int fluid);
/* Whether two fluids have faces within reach of x. */
bool wall_joint_parts(const struct wall_joint *j, const double *x, double reach);

#endif
