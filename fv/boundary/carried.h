/* carried.h - lists of the cells and faces of openings whose values change with the flow: of
 * convective outflows (outflow.h), and of openings whose pressure is given (levels.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_CARRIED_H
#define FV_CARRIED_H

#include "../fv.h"

/* Convective; with a discharge that the case gives; an inflow under a surface with a velocity that
 * it gives. */
enum outflow_kind { OUTFLOW_CONVECTS, OUTFLOW_GIVEN_IN, OUTFLOW_GIVEN_OUT, OUTFLOW_STEADY };

/* One opening of this rank, a side of its block or of one of its parts. Arrays are [n] and
 * owned. */
struct outflow {
    int side;        /* of the domain, as in bc.h */
    int a;           /* axis across it */
    int64_t in;      /* offset one cell inwards */
    int64_t face;    /* from a cell inside to its face in U */
    int64_t n;       /* places, ghosts of its tangents included */
    int64_t *place;  /* in the side's arrays */
    int64_t *cell;   /* inside */
    bool *own;       /* its face is one of this rank's, once */
    double *share;   /* -: of its face that counts as under water, 0 or 1; 1 without a surface */
    double *wet;     /* -: fraction of the cell inside that is water */
    double *S[3];    /* m^(dim-1): of its face, outwards */
    double *h;       /* m: of the cell inside, across the side */
    double *w[3];    /* m/s: the side's own array */
    double *line[3]; /* [3 n]: the step's first velocity inwards, w + b x + c x^2, x in cells */
    enum outflow_kind kind;
    double discharge;  /* m^dim/s: given, outwards through the whole side, now */
    double *change[3]; /* [places of the side] m/s: of w at the last outflow_set */
    /* Of held inflows (surface/held_inflow.h), [n]; else NULL: */
    double *level;    /* m: phi of the cell inside at the start */
    double *stood;    /* -: share of water in it then; 0: the face is closed to water */
    double *full;     /* -: of what comes in now */
    double *given[3]; /* m/s: w of the start */
};

/* All openings of this rank with the figures of each side of the domain, which are equal on all
 * ranks. */
struct outflows {
    int n;
    struct outflow *of;
    double flow[6];    /* m/s: mean velocity outwards of each side of the domain, >= 0 */
    double waves[6];   /* m/s: of long waves under a surface, else 0 */
    double pull[6];    /* m/s: by which the mean velocity of a side differs from its level's */
    double hurry[6];   /* 1/s: rate at which it relaxes towards that */
    double rest[6];    /* m/s: mean velocity of the start less 2 sqrt(g H) of it: what comes in from
                        * outside under a surface */
    double leaves[6];  /* m^dim/s: given discharge of a side now, outwards; 0: none, or inwards */
    bool given_out[6]; /* the side has one, outwards */
    double passed[6];  /* m^dim: of this step and rank */
    bool short_told[6];     /* that an outlet has too little water was told */
    double lacks[6];        /* m^dim: what has not passed yet; equal on all ranks */
    double lacks_before[6]; /* when a step began that may be taken back */
    double area[6];         /* m^(dim-1): of the water in each side of the domain */
    bool held[6];           /* the inflow brings in the water of the start (held_inflow.h) */
    bool convects;          /* one of them does, on any rank */
    bool steady;            /* one is an inflow of given velocity */
    bool level_free;        /* a surface takes the difference of what comes in and leaves */
    double *kept[3]; /* fields, for restart files: w, m/s, in the first ghost behind the side;
                      * kept[0]: full in the second one, -1 for 0 */
    double given;    /* m^dim/s: through this rank's other faces of given velocity, outwards */
    double all;      /* with these */
};

/* Visits the openings whose velocity changes: o. */
#define OUTFLOWS(s, o)                                                                             \
    for (struct outflow *o = (s)->outflows ? (s)->outflows->of : NULL;                             \
         o && o < (s)->outflows->of + (s)->outflows->n; o++)

/* The kind of an opening of the scene. */
enum outflow_kind carried_kind(const struct scene_wall *w);
/* Whether its velocity inwards is given. */
static inline bool carried_comes_in(const struct outflow *o)
{
    return o->kind == OUTFLOW_GIVEN_IN || o->kind == OUTFLOW_STEADY;
}
/* The kind of a side whose wall is w (NULL: none) in this run: inflows of given velocity under a
 * surface are listed, too. */
enum mesh_side carried_side(const struct fv *s, const struct scene_wall *w, enum mesh_side kind);
/* -: of what comes in through a held inflow beside cell c that is water; -1: no such face. in:
 * offset one cell inwards. */
static inline double carried_held(const struct fv *s, int64_t c, int64_t in)
{
    const double kept = s->outflows ? s->outflows->kept[0][c - 2 * in] : 0.0;
    return kept > 0.0 ? kept : kept < 0.0 ? 0.0 : -1.0;
}
/* Makes s->outflows if some side's velocity changes; on all ranks alike. */
void carried_create(struct fv *s);
/* Adds an opening with room for n cells, none filled, to *list; a: the axis across it, in: offset
 * inwards, values: entries of w. */
struct outflow *carried_add(void *owner, struct outflow **list, int *count, int dim, int side,
                            int a, int64_t in, int64_t n, int64_t values);
/* Flow outwards through face i of an opening, m^dim/s, and the size of the face, m^(dim-1). */
double carried_flux(const struct outflow *o, int dim, int64_t i);
double carried_area(const struct outflow *o, int64_t i);
/* Lowers phi, m, in the ghosts behind the water of held inflows to that of the start. */
void carried_level_ghosts(const struct fv *s, double *phi);
/* Sets C, shares of water, in these ghosts. */
void carried_share_ghosts(const struct fv *s, double *C);

#endif
