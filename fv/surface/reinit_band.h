/* reinit_band.h - the band of a reinitialisation, and what it needs of each kind of cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_REINIT_BAND_H
#define FV_REINIT_BAND_H

#include "../fv.h"

/* A run of cells of the band along x. */
struct strip {
    const struct part *part;
    int64_t cell, n;
    int row;     /* local */
    double dtau; /* m: pseudo step of those that are no spots; on blocks each cell has its own */
};

/* A cell of the band between which and a neighbour the surface passes, or whose distance from it
 * closest.c knows. */
struct spot {
    const struct part *part;
    int64_t cell;
    double sign, dtau;  /* -, m; 0: phi is held */
    double reach[3][2]; /* m, on blocks cells: way to the surface along each axis, down and up; 0:
                           none */
};

/* The band on this rank: strips cover what changes of it, spots are the cells of it at the surface.
 */
struct band {
    int64_t nstrips, nspots;
    bool exact; /* distances that are known are held */
    struct strip *strips;
    struct spot *spots;
};

/* What a reinitialisation asks of a kind of cells. */
struct reinit_ops {
    /* m: size of the cell of local row j along axis a; its step to the next one, as `reach' has it,
     * and in m. */
    double (*height)(const struct fv *s, const struct part *p, int64_t c, int a, int j);
    double (*step)(const struct fv *s, int a, int j, double height, double *length);
    /* m: pseudo step of a strip of local row j; 0: each cell has its own. */
    double (*strip_step)(const struct fv *s, int j);
    /* Whether the distance of a cell is known or held, as *exact; narrow: of a step's small change.
     * NULL: it never is. */
    bool (*is_known)(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                     bool narrow, double *exact);
    /* Change of phi over a pseudo step in the strips; old: phi at its start, which has the sign. */
    void (*rates)(const struct fv *s, const double *phi, const double *old, const struct band *w,
                  double *rate);
    /* |grad phi| beside the surface, where slopes end on it. */
    double (*size_beside)(const struct fv *s, const double *phi, const struct spot *x);
};

/* Of uniform cells and layers of unequal height; of blocks; of blocks whose lines of cells are all
 * straight and at right angles. */
extern const struct reinit_ops even_reinit, block_reinit, box_reinit;
/* reinit_even.c: is_known of those of them that have one. */
bool reinit_is_known(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                     bool narrow, double *exact);

/* The pseudo step over the least size of a cell, -. */
static inline double reinit_cfl(const struct fv *s) { return s->dim == 3 ? 0.3 : 0.45; }

/* The argument of the smaller size, or 0 where the signs differ. */
static inline double minmod(double a, double b)
{
    return a * b <= 0.0 ? 0.0 : fabs(a) < fabs(b) ? a : b;
}

/* Second difference of q at the cell (not divided). */
static inline double bend(const double *q, int64_t d) { return q[d] - 2.0 * q[0] + q[-d]; }

#endif
