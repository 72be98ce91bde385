/* parted.h - parts of the fluid between which partners' cells leave no way: a box of SPH that
 * reaches from wall to wall cuts the uniform cells in two. A part of which no side gives the
 * pressure floats: its pressure is known up to a constant of its own, and what flows through its
 * interface has to balance what flows through its sides.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_PARTED_H
#define FV_PARTED_H

#include "../fv.h"

/* Most parts; with more of them parted_create gives up. */
enum { PARTS_MAX = 2 * PARTNERS_MAX };

/* The parts of the fluid. Figures of parts are the same on all ranks. */
struct parted {
    const unsigned char *forced; /* [size] of struct forcing, borrowed: 0: computed */
    int n;                       /* parts, at most PARTS_MAX */
    signed char *of;         /* [size] part of each cell, those of ghosts and imposed ones, too */
    bool floats[PARTS_MAX];  /* no side gives its pressure */
    double cells[PARTS_MAX]; /* computed ones, of all ranks */
};

/* NULL unless whole layers of imposed cells lie between computed ones and some part floats.
 * `forced' as in struct forcing. Uniform cells without a surface alone. Collective. */
struct parted *parted_create(const struct fv *s, const unsigned char *forced);
/* Whether no side gives the pressure of any part. */
bool parted_all_float(const struct parted *p);
/* Takes the mean over the computed cells of each floating part out of x, a field that is 0 in
 * imposed cells. Collective. */
void parted_remove_means(const struct parted *p, const struct fv *s, double *x);
/* m^dim/s: net flux out of the computed cells of each part through all of their faces; U: m/s
 * through lower faces. Collective. */
void parted_net_fluxes(const struct parted *p, const struct fv *s, double *const U[3],
                       double net[PARTS_MAX]);
/* Adds `more', m^2/s^2, to the pressure of each floating part. */
void parted_shift(const struct parted *p, struct fv *s, const double more[PARTS_MAX]);

#endif
