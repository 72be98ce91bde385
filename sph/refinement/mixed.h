/* mixed.h - one set of particles of different sizes: the methods that adaptive refinement with
 * guards is compared with (Chiron 2017, 5.2). Each particle has its own R; a pair has the mean of
 * both, so that what one gives the other takes. In 2D, on one rank, with Riemann schemes, plane
 * sides as mirrors. Simple on purpose.
 *   graded       the spacing grows away from a box, by less than 3 % from neighbour to neighbour
 *   weights      parents stay beside their children; each source counts with a weight chi that goes
 *                from 0 to 1 within R inside the edge, of the other generation the rest (Barcarolo:
 *                [5.12-5.13])
 *   coalescence  parents split into four, which merge in pairs outside (Vacondio: [5.6-5.11])
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_MIXED_H
#define SPH_MIXED_H

#include "../sph.h"
#include "apr_params.h"

struct mixed;
struct faults;
struct h5;

/* Adds faults for what these methods cannot be combined with. */
void mixed_check(const struct run *r, const struct sph_params *used, const struct apr_params *prm,
                 struct faults *f);

/* After the first particles of the coarsest size: makes those of the other sizes. s->refinement
 * exists. */
void mixed_start(struct sph *s);
/* Reads the sizes from a restart file, after the particles; false: it has none. */
bool mixed_restart(struct sph *s, struct h5 *f);
/* The smallest R, m, on which the step depends. */
double mixed_least(const struct sph *s);

/* The list of pairs takes three calls, instead of neighbours_sort and neighbours_build. mixed_sort
 * puts particles that are near each other side by side in memory, every so many steps: for speed
 * alone. */
void mixed_sort(struct sph *s);
/* After the periodic images have been made: gives them the sizes of their originals. */
void mixed_images(struct sph *s);
/* Lists each pair once, by the classes of both, and lays it out as neighbours_build does. */
void mixed_list(struct sph *s);
/* At the end of a step: creations, removals, weights. */
void mixed_adapt(struct sph *s);

/* mixed_pairs.c: the two passes of pairs/scheme.h for particles of different sizes. The first makes
 * slopes, shifting and the surface; the second the rates of the Riemann scheme. */
void mixed_gradients(struct sph *s);
void mixed_rates(struct sph *s);

/* Called by mixed_adapt. mixed_weights.c: makes and removes children, and sets the weights of both
 * generations. */
void mixed_weights(struct sph *s);
/* mixed_merge.c: splits parents inside, merges pairs outside; drops the ghosts first, since
 * particles come and go. */
void mixed_split(struct sph *s);

/* graded.c: makes the first particles, instead of a lattice. */
void graded_fill(struct sph *s);

/* R of particle i, and its weight. */
static inline double *mixed_R(const struct sph *s, int i) { return &s->p.size[i][0]; }
static inline double *mixed_weight(const struct sph *s, int i) { return &s->p.size[i][1]; }
/* Adds one of the 2^D children of half the size of particle i, displaced by d, m, with its fields
 * extrapolated there and the support R, m; returns its index. */
int mixed_bear(struct sph *s, int i, const double *d, double R);

#endif
