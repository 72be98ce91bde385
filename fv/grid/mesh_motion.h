/* mesh_motion.h - blocks that move rigidly as prescribed: their position at a time, the velocity of
 * their cells. Volumes and the tensor G do not change; area vectors rotate with the block. The flux
 * of the cells' own velocity through a face, w.S + omega.(integral of r cross dS), is exact for its
 * edges, so that those of a cell sum to zero: a uniform flow stays uniform whatever the motion
 * (geometric conservation).
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/scene/scene.h"
#include "mesh.h"

/* The motion of a block and of the blocks joined to it. */
struct mesh_motion {
    int block; /* the one whose key gives the motion */
    struct body_drive drive;
    struct body_motion now;
    double t;         /* s: of now */
    double centre[3]; /* m: of rotation, where the block is made */
    double reach;     /* m: of its farthest vertex from there */
    double speed;     /* m/s: largest of a point of it within the run */
    bool turns;       /* ever */
};

/* Makes the motions and places the blocks at time t, s; false: faults were added. */
bool mesh_motion_create(const struct run *r, struct faults *f, struct mesh *m, double t);
/* After the metrics: keeps the area vectors and moments of the faces of blocks that move, as they
 * are made, for mesh_motion_place to turn. */
void mesh_motion_metrics(struct mesh *m);
/* Sets vertices, centres, area vectors and the flux of the grid for time t, s. Donors, and what
 * each cell is, stay as they were. A motion that changes at once has two velocities then: that of
 * before at the time m->turn. */
void mesh_motion_place(struct mesh *m, double t);
/* Velocity of the block's material point that is at x now, m/s. */
void mesh_motion_velocity(const struct mesh_block *b, const double *x, double *w);
/* Where the point that is at x now was when the block was made, m. */
void mesh_motion_made(const struct mesh_block *b, const double *x, double *to);
/* The inverse: where the point now is that the block had at `made', m. */
void mesh_motion_now(const struct mesh_block *b, const double *made, double *to);
