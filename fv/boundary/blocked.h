/* blocked.h - boxes of cells that are cut out of a uniform grid: solid bodies at rest, whose faces
 * are no-slip or slip walls. Their cells take no part (forcing.h); beside them stencils continue by
 * the ghosts of bc.c, which belong to a cell and an axis: behind an edge, or in a thin box, one
 * cell stands for several ghosts.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_BLOCKED_H
#define FV_BLOCKED_H

#include "../fv.h"

/* Most boxes of a case; cells that a ghost is made of; cells needed between no-slip faces. Of three
 * the middle one is made of both walls' ghosts, and the flow grows without bound from U h/nu = 3
 * on; of four it does not at 3e4. */
enum { BLOCKED_MAX = 16, BLOCKED_GAP = 3, BLOCKED_GAP_NO_SLIP = 4 };

/* A box of the case. */
struct blocked_params {
    char name[PARAM_TEXT_SIZE];
    double min[3], max[3]; /* m */
    int kind;              /* WALL_SLIP or WALL_NO_SLIP */
    int body;              /* 1 + number of the body that it is; 0: of the list blocked */
};

/* How a ghost behind a box's face follows from the cells before it: zero gradient, antisymmetric,
 * no-slip, linear. */
enum blocked_ghost { GHOST_EVEN, GHOST_ODD, GHOST_NO_SLIP, GHOST_LINEAR };

/* A free cell near a box along an axis. */
struct near_box {
    int64_t cell;
    int free[2]; /* cells that follow below and above, at most 3 */
    int box[2];  /* that ends them, where they are fewer */
    bool own;    /* of this rank, no ghost */
};

/* A face between free cells beside which, along t, a box lies. */
struct beside_box {
    int64_t face, in; /* index in U; step away from the box */
    int box;
    bool both; /* on both sides */
};

/* The boxes as this rank has them; s->blocked. Arrays are owned. */
struct blocked {
    unsigned char *box; /* [size] 0: free, else 1 + the box's number; ghosts as the cells before */
    /* [size] bit 2 a + up: air comes in through the box's face below or above the cell along a; of
     * this rank's cells and one layer around. surface/vents.c sets it. */
    unsigned char *vent;
    int64_t nnear[3];
    struct near_box *near[3];
    double (*slip[3])[2][3]; /* m/s: what the next projection takes off the velocity on a box behind
                                a cell, below and above; as bc.h has it */
    int64_t nbeside[3][3];
    struct beside_box *beside[3][3]; /* faces along a, boxes along t */
};

/* Cells lo <= i < hi of the whole grid that the k-th box of the case takes, its faces moved to the
 * nearest faces of cells. */
void blocked_cells(const struct scene_domain *d, const struct fv_params *p, int k, int lo[3],
                   int hi[3]);
/* NULL if the case has no boxes. Owned by the caller. */
struct blocked *blocked_create(const struct fv *s);

/* A free cell of this rank as list near has it, along the axis a: near a box or not. */
struct near_box blocked_near(const struct fv *s, int64_t c, int a);
/* The rule behind a box's face for component q along axis a (q < 0: for a scalar). */
enum blocked_ghost blocked_rule(const struct fv *s, int box, int q, int a);
/* Sets v[-reach .. reach] to q around the cell along the offset d, with ghosts behind boxes. */
void blocked_line(const struct near_box *x, const double *q, int64_t d, int reach,
                  const enum blocked_ghost rule[2], double *v);
/* The ghost number `depth' behind a box; q is its first free cell and `in' the offset away from
 * it. */
double blocked_ghost(const double *q, int64_t in, int depth, enum blocked_ghost rule);

/* Whether a box cuts out the cell at place c; a ghost behind a closed side is as the cell before
 * it. */
static inline bool is_blocked(const struct fv *s, int64_t c)
{
    return s->blocked && s->blocked->box[c];
}
/* Whether air comes in through the box's face along a below (up 0) or above the cell c. */
static inline bool blocked_vents(const struct fv *s, int a, int64_t c, int up)
{
    return s->blocked && s->blocked->vent[c] >> (2 * a + up) & 1;
}
/* q of the neighbour c + d, or that of c where a box is there. */
static inline double blocked_beside(const struct fv *s, const double *q, int64_t c, int64_t d)
{
    return is_blocked(s, c + d) ? q[c] : q[c + d];
}
/* v[-2 .. 2] of a scalar with zero gradient at boxes. */
static inline void blocked_even_line(const struct fv *s, const double *q, int64_t c, int64_t d,
                                     double *v)
{
    for (int m = -2; m <= 2; m++)
        v[m] = q[c + m * d];
    for (int way = -1; way <= 1 && s->blocked; way += 2)
        if (s->blocked->box[c + way * d]) {
            v[way] = v[0];
            v[2 * way] = q[c - way * d];
        } else if (s->blocked->box[c + 2 * way * d]) {
            v[2 * way] = q[c + way * d];
        }
}

#endif
