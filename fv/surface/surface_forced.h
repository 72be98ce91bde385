/* surface_forced.h - the level set in cells that a partner's particles fill: from the fraction of a
 * kernel that its water takes there (common/waves/colour.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_SURFACE_FORCED_H
#define FV_SURFACE_FORCED_H

#include "../fv.h"

/* The cells and the partner's phi there at both ends of a coupling step. */
struct surface_forced {
    int64_t nforced, n, *cell; /* local: imposed ones, then free ones beside the interface */
    bool *holds;               /* [size] of blocks: the former; NULL: even cells */
    int64_t nplaces, *first;   /* [n + 1] places of each cell: its centre, images beyond walls */
    double *x;                 /* [nplaces][3] m */
    double h, R;               /* m: largest spacing of these cells; support of the kernel */
    double *profile;           /* of colour.h */
    double *phi[2];            /* [size] m: at the start and at the end of the coupling step */
    double t[2];               /* s */
    /* m: mean difference of phi of the free cells from the partner's, at the interface. */
    double step;
};

/* For the cells of s->forcing; NULL without. Owned by the caller. */
struct surface_forced *surface_forced_create(const struct fv *s);
/* The next coupling step, t0 to t1, s, begins: phi[0] becomes phi[1], whose new values are
 * extrapolated. */
void surface_forced_shift(struct fv *s, double t0, double t1);
/* Sets phi[1] from the kernel fractions at the positions x, share[nplaces]. Collective. */
void surface_forced_take(struct fv *s, const double *share);
/* Sets phi of imposed cells at time t, s, linearly in time, and its ghosts. Where the partner's
 * water is further than 0.95 of what the kernel reaches only the sign counts, and phi stays if it
 * agrees. */
void surface_forced_impose(struct fv *s, double t);

#endif
