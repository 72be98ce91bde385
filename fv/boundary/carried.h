/* carried.h - lists of the places of openings: of convective outflows (outflow.h), and of those
 * whose pressure is given (levels.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_CARRIED_H
#define FV_CARRIED_H

#include "../fv.h"

/* Convective, or with a discharge that the case gives. */
enum outflow_kind { OUTFLOW_CONVECTS, OUTFLOW_GIVEN_IN, OUTFLOW_GIVEN_OUT };

/* One of this rank's: of its block, or of one of its parts. */
struct outflow {
    int side;        /* of the domain, as in bc.h */
    int a;           /* axis across it */
    int64_t in;      /* step inwards */
    int64_t face;    /* from a cell inside to its face in U */
    int64_t n;       /* places, ghosts of its tangents included */
    int64_t *place;  /* in the side's arrays */
    int64_t *cell;   /* inside */
    bool *own;       /* its face is one of this rank's, once */
    double *share;   /* -: of its face that is under water, all or nothing; 1 without a surface */
    double *wet;     /* -: of the cell inside that is water, which the surface cuts */
    double *S[3];    /* m^(dim-1): of its face, outwards */
    double *h;       /* m: of the cell inside, across the side */
    double *w[3];    /* m/s: the side's own array */
    double *line[3]; /* [3 n]: the step's first velocity inwards, w + b x + c x^2, x in cells */
    enum outflow_kind kind;
    double discharge;  /* m^dim/s: given, outwards through the whole side, now */
    double *change[3]; /* [places of the side] m/s: of w at the last outflow_set */
};

struct outflows {
    int n;
    struct outflow *of;
    double flow[6];    /* m/s: mean velocity outwards of each side of the domain, >= 0 */
    double waves[6];   /* m/s: of long waves under a surface, else 0 */
    double pull[6];    /* m/s: by which the mean velocity of a side differs from its level's */
    double hurry[6];   /* 1/s: how fast it returns to that */
    double rest[6];    /* m/s: mean velocity of the start less 2 sqrt(g H) of it: what comes in from
                        * outside under a surface */
    double leaves[6];  /* m^dim/s: given discharge of a side now, outwards; 0: none, or inwards */
    bool given_out[6]; /* the side has one, outwards */
    double area[6];    /* m^(dim-1): of the water in each side of the domain */
    bool convects;     /* one of them does, on any rank */
    bool level_free;   /* a surface takes what comes in and does not leave */
    double *kept[3];   /* m/s: fields: w in the first ghost behind the side, for restart files */
    double given;      /* m^dim/s: through this rank's other faces of given velocity, outwards */
    double all;        /* with these */
};

enum outflow_kind carried_kind(const struct scene_wall *w);
/* Takes the discharges that are given for time t. */
void carried_set_discharges(struct fv *s, double t);
/* Makes s->outflows where some side's velocity changes, on all ranks. */
void carried_create(struct fv *s);
/* Adds to a list one with room for n places, none filled, across axis a; values: of w. */
struct outflow *carried_add(struct outflow **list, int *count, int dim, int side, int a, int64_t in,
                            int64_t n, int64_t values);
void carried_free(struct outflows **o);
void carried_free_list(struct outflow **list, int n);
/* Outwards through a face, m^dim/s, and its size. */
double carried_flux(const struct outflow *o, int dim, int64_t i);
double carried_area(const struct outflow *o, int64_t i);

#endif
