/* mesh_motion.h - blocks that move as prescribed, rigidly: their places at a time, the velocity of
 * their cells. Volumes and the tensor G do not change; face vectors turn with the block. The flux
 * of the cells' own velocity through a face, w.S + omega.int r cross dS, is exact for its edges, so
 * that those of a cell sum to zero: a uniform flow stays uniform whatever the motion.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_MOTION_H
#define FV_MESH_MOTION_H

#include "../../common/scene/body_drive.h"
#include "mesh.h"

struct mesh_motion {
    int block; /* whose key tells it; blocks joined to it move with it */
    struct body_drive drive;
    struct body_motion now;
    double t;         /* s: of now */
    double centre[3]; /* m: of rotation, where the block is made */
    double reach;     /* m: of its farthest vertex from there */
    double speed;     /* m/s: largest of a point of it within the run */
    bool turns;       /* ever */
};

/* Motions of the blocks that have one and of those joined to them; false: faults were added. The
 * blocks are placed at time t. */
bool mesh_motion_create(const struct run *r, struct faults *f, struct mesh *m, double t);
void mesh_motion_free(struct mesh *m);
/* After the metrics: what turns with the blocks. */
void mesh_motion_metrics(struct mesh *m);
/* Places vertices, centres, face vectors and the flux of the grid at time t. Donors and what cells
 * are stay as they were. */
void mesh_motion_place(struct mesh *m, double t);
/* Velocity of a block's point at x, m/s. */
void mesh_motion_velocity(const struct mesh_block *b, const double *x, double *w);
/* Where a point at x was when the block was made, and back. */
void mesh_motion_made(const struct mesh_block *b, const double *x, double *to);
void mesh_motion_now(const struct mesh_block *b, const double *made, double *to);

#endif
