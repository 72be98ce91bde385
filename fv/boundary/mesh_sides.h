/* mesh_sides.h - what the files of mesh_bc.h share of the physical sides of blocks; private to
 * them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_SIDES_H
#define FV_MESH_SIDES_H

#include "../fv.h"
#include "../grid/fv_grid.h"
#include "mesh_bc.h"

/* A side of one part of this rank; arrays are owned. */
struct side {
    const struct part *p;
    int a, k; /* axis, side of the block */
    enum mesh_side kind;
    bool slides;          /* a wall that moves along itself */
    int t[2], g[2], n[2]; /* tangents, their ghosts and cells */
    int first;            /* cell along a that touches the side */
    int64_t in;           /* offset one cell inwards */
    int64_t face;         /* offset from that cell to the face's index in U */
    int64_t width;
    bool moves;              /* with its block */
    bool bends;              /* its normals are not all alike */
    bool body;               /* forces on it count */
    double pressure;         /* m^2/s^2: p/rho of an outflow */
    double *w[3], *w_old[3]; /* m/s: now and before the last change of time */
    double *slip[3];         /* m/s: what the next projection will take off the side's velocity */
    double *grad_xi[2][3];   /* 1/m: of the tangents' indices on the face */
    double *once;            /* -: share of each face that counts once; NULL: all */
    double *tilt;            /* m: slope outwards, a cell, of a level set; NULL: there is none */
    double *rise;            /* m^2/s^2: by how much p/rho rose outwards over the cell, as the wall
                              * accelerates, in the last projection; NULL: nothing */
    double *turn;            /* m^dim/s: what the flux across it gains in a stage as water follows a
                              * wall that bends or turns; NULL: nothing */
};

/* A place beyond a part's side, where the wall goes on: on a neighbour, who knows the slip. */
struct beyond {
    int side;
    int64_t at, ghost; /* in the side's values; in fields, the first ghost behind the wall */
};

/* All sides of this rank. */
struct mesh_bc {
    int n;
    struct side *side;
    int nbeyond;
    struct beyond *beyond;
    struct mesh_exchange walls; /* from ghosts behind walls to those of `beyond' */
    bool pressure_given;
    bool set;         /* values have been */
    bool shared;      /* shares of faces have been found, for */
    double shared_at; /* s */
};

/* shared_faces.c: where blocks overlap, the shares of their walls' faces that count once, if those
 * of this time are not known. */
void mesh_bc_share_faces(const struct fv *s);

/* With a surface the projection takes the whole pressure off, whose slope at a wall is less the
 * acceleration across it of the water there, that of the wall and, beside a slip wall that bends or
 * turns, that of the way along it: ahead of the projection the velocity across is that of the stage
 * before. Water at a no-slip wall goes with it. */
static inline bool side_accelerates(const struct fv *s, const struct side *d)
{
    return s->surface &&
           ((d->kind == MESH_WALL && d->moves) || (d->kind == MESH_SLIP && (d->moves || d->bends)));
}

/* Index in the side's values of the place (i, j) along its tangents; side_cell: index in a field of
 * the cell inside. */
static inline int64_t side_place(const struct side *s, int i, int j)
{
    return (i + s->g[0]) + s->width * (j + s->g[1]);
}

static inline int64_t side_cell(const struct side *s, int i, int j)
{
    int at[3];
    at[s->a] = s->first;
    at[s->t[0]] = i;
    at[s->t[1]] = j;
    return part_at(s->p, at[0], at[1], at[2]);
}

/* Visits the places of a side with all ghosts of its tangents: m counts them, c: cell inside. */
#define SIDE_PLACES(s, more, i, j, m, c)                                                           \
    for (int j = -(more) * (s)->g[1]; j < (s)->n[1] + (more) * (s)->g[1]; j++)                     \
        for (int i = -(more) * (s)->g[0]; i < (s)->n[0] + (more) * (s)->g[0]; i++)                 \
            for (int64_t m = side_place(s, i, j), c = side_cell(s, i, j), its_once_##c = 1;        \
                 its_once_##c; its_once_##c = 0)

#endif
