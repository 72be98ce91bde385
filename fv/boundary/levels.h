/* levels.h - openings under a free surface whose pressure is given: hydrostatic from a level, less
 * the dynamic pressure of what comes in there. Outside the water is at rest, and nothing comes in
 * faster than its head allows (Bernoulli; the directional do-nothing condition of Braack & Mucha
 * 2014), so that water that runs back brings no more energy than it had. Waves that reach an
 * opening leave: g (eta - L) = c (u - U), c = sqrt(g H), U the mean velocity of the last two
 * transits of the domain. Where L follows a file U goes on with the flow that fills and empties the
 * basin: it would be behind by two transits, and a tide swing too far. Where L lies below the
 * critical depth of what leaves, critical flow at most stands outside. Where no water stands
 * outside, water falls out with p = 0 on the faces. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_LEVELS_H
#define FV_LEVELS_H

#include "../fv.h"
#include "../grid/fv_grid.h"

/* Groups of openings that have one level: those on each side of the domain, and those within it. */
enum { LEVEL_GROUPS = MESH_OUTSIDES };

struct outflow; /* carried.h */
/* The openings of this rank, and the figures of each group of them (MESH_OUTSIDES), which are equal
 * on all ranks. */
struct levels {
    int n;
    struct outflow *of;         /* [n] the openings; owned */
    double *p;                  /* m^2/s^2: field: p/rho on the face, in the first ghost behind it,
                                 * less that of water at rest; NULL: no surface, nothing is set */
    double level[LEVEL_GROUPS]; /* m: of the water outside */
    bool inlet[LEVEL_GROUPS];   /* the level is that in the opening, not that far outside */
    bool falls[LEVEL_GROUPS];   /* nothing stands outside: p = 0 on the faces */
    double waves[LEVEL_GROUPS]; /* m/s: c */
    double tide[LEVEL_GROUPS];  /* s: over which the rise of a level from a file is taken, half a
                                 * transit; 0: no file */
    double surge[LEVEL_GROUPS]; /* m: by how much that level changes at most within it */
    double basin[LEVEL_GROUPS]; /* -: of those, plan area of the water that stands as high as in the
                                 * opening, over the area of all openings of given level */
    double mean[LEVEL_GROUPS];  /* m/s: velocity outwards of its water now */
    double middle[LEVEL_GROUPS]; /* m: height of the middle of its water */
    double fall[LEVEL_GROUPS];   /* m: see openings_fall */
    double past[LEVEL_GROUPS];   /* m/s: U */
    double kept[LEVEL_GROUPS];   /* m/s: U when a step began that may be taken back */
};

/* Makes s->levels; before the sides are made, which list their cells. */
void levels_create(struct fv *s);
/* Whether any pressure is set. */
bool levels_set_any(const struct fv *s);
/* At the start of a run under a surface: sets the level outside of each group, from the case or
 * from the water that stands there, and the velocities; does nothing without a surface. Collective,
 * as levels_begin. */
void levels_start(struct fv *s);
/* Before a step of dt, s: measures velocities and the speed of waves. */
void levels_begin(struct fv *s, double dt);
/* Keeps U before a step that may be taken back. */
void levels_keep(struct fv *s);
/* Restores U where such a step is taken back. */
void levels_back(struct fv *s);
/* Before a stage that ends at t, s: sets the pressures on the faces, from the projected fluxes. */
void levels_set(struct fv *s, double t);
/* Before a projection of length tau, s: applies these pressures to the fluxes, so that psi is 0 on
 * the faces in the solve. */
void levels_fluxes(struct fv *s, double tau);
/* After it, on blocks: sets the ghosts of psi behind these openings. */
void levels_ghosts(const struct fv *s, double *psi);
/* On uniform cells: adds to the gradient of psi along axis a, in `out', what these pressures
 * contribute. */
void levels_gradient(const struct fv *s, int a, double *out);
/* The same on the faces. */
void levels_face_gradient(const struct fv *s, int a, double *out);

#endif
