/* wall_joint.h - points of the plane where walls touch and separate the fluid: a flap that stands
 * on the floor, two bodies that lean on each other. The solid is thinner there than any support, so
 * that particles on one side would interact with those on the other, and with the walls of the
 * other side, through it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_JOINT_H
#define SPH_WALL_JOINT_H

#include "walls.h"

/* The part of a segment that bounds one of the fluids which a joint separates. */
struct joint_face {
    struct segment is; /* that part */
    int piece, fluid;  /* index of the segment; which fluid, from 0 */
    double from, to;   /* m along the segment */
};

enum { JOINT_FACES = 128, JOINT_MEETS = 4 };

/* One such point with the faces that leave it, fluid by fluid. Round a small body two fluids may
 * meet again, where the faces of one go on as those of the other. */
struct wall_joint {
    double x[2]; /* m */
    int nfaces, nfluids, nmeets;
    double meet[JOINT_MEETS][2]; /* m: the corners where that is */
    struct joint_face face[JOINT_FACES];
};

/* All joints; of is owned. Zeroed memory is empty. */
struct wall_joints {
    int n;
    int nfixed; /* the first so many joints are of walls that never move */
    bool known; /* the fixed ones have been found */
    struct wall_joint *of;
};

/* Finds the joints of the walls as they are now. Walls touch where they are nearer to each other
 * than dx/10; faces are followed to 2 R from the joint. */
void wall_joints_find(const struct sph *s, struct wall_joints *to);
/* Which of its fluids holds x: of those whose faces x is before, the one with the nearest; behind
 * all faces that with the nearest. */
int wall_joint_fluid(const struct wall_joint *j, const double *x);
/* Whether x and y lie in different fluids with walls of the joint between them. */
bool wall_joint_hides(const struct wall_joint *j, const double *x, const double *y);
/* The part of a segment that bounds a fluid; NULL: none does. Borrowed. */
const struct joint_face *wall_joint_face(const struct wall_joint *j, int piece, int fluid);
/* Whether two fluids have faces within reach of x, on this side of where they meet again. */
bool wall_joint_parts(const struct wall_joint *j, const double *x, double reach);
/* Whether a wall too thin for the support, through which pairs do not see either, stands between a
 * particle at x and the place x + d, m: a thin mesh, or a body beside the point where it touches
 * another wall. A place on such a wall is seen from both sides. */
bool walls_hide(const struct sph *s, const double *x, const double *d);

#endif
