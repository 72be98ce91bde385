/* body_touch.h - where two bodies, or a body and walls at rest, touch.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_TOUCH_H
#define SPH_BODY_TOUCH_H

#include "../walls/sph_walls.h"

/* A corner of one near the other. */
struct touch {
    double x[3], out[3]; /* m: position of the corner; unit normal out of what is touched */
    double shift[3];     /* m: how far what is touched of the second body stands from that body */
    double depth, u[3];  /* m; m/s of the corner's body relative to what it touches */
    bool mine;           /* the corner belongs to the first of the pair */
    int of, corner;      /* pieces and image of the second body, number of the corner: its own */
    bool sharp;          /* the surface turns by more than 30 degrees at the corner */
};

/* Two bodies with their touches; touch is owned. */
struct pair {
    int a, b;        /* bodies; b = -1: walls at rest */
    int image;       /* number of the image of b across periods that is looked at */
    double shift[3]; /* m: from b to that */
    int n;
    struct touch *touch;
};

/* Adds a corner at `at.x' that is `at.depth' nearer than the distance that contact keeps; what
 * depends on the pair is filled in. */
void pair_add(const struct walls *w, struct pair *p, const struct touch *at);
/* Signed distance, m, of x to the surface of a body (-1: walls at rest) or of its images across
 * periods within reach, with the unit normal out of it; INFINITY: nothing is within reach. */
double touch_distance(const struct walls *w, int dim, int body, const double *x, double reach,
                      double out[3]);
/* Faces of bodies that stand on or beside each other may be flush, as in a pile: a corner that is
 * pressed in by next to nothing may then be nearer to a side than to the face that it stands on. So
 * one that is no farther than TOUCH_FLUSH gaps from what it touches is looked at from a place so
 * far inside its own solid. */
#define TOUCH_FLUSH 0.1
/* The distance of a corner, m, from the face that counts, whose normal goes to out. d: from what is
 * nearest to it, with the normal out; way: to the place inside, m; e, beside: the same of that
 * place. */
double touch_settle(double d, const double way[3], double e, const double beside[3], double out[3]);
/* *y: where x, beside the first body of the pair, lies beside the second. */
void pair_beside(const struct pair *p, const double *x, double y[3], int dim);
/* Whether x is within `gap', m, of the axis that one of the two is hinged about. */
bool pair_is_held(const struct walls *w, const struct pair *p, const double *x, double gap);
/* Adds all corners nearer than `gap', m, to b where p->shift has it: of polylines; pair_find3
 * (body_touch3.c) of meshes. */
void pair_find2(const struct walls *w, struct pair *p, double gap);
double touch_distance3(const struct walls *w, int body, const double *x, double reach,
                       double out[3]);
void pair_find3(const struct walls *w, struct pair *p, double gap);

#endif
