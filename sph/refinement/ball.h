/* ball.h - signed distance to the edge of a ball (2D: a disc) that walls cut.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BALL_H
#define SPH_BALL_H

struct box;

struct ball {
    double centre[3], radius; /* m */
};

/* Signed distance of x, m, positive inside. Inside it is the distance to the part of the sphere
 * that lies within `room', whose faces are walls or at infinity; INFINITY: there is none. x must
 * lie in room. */
double ball_distance(const struct ball *b, int dim, const struct box *room, const double *x);

#endif
