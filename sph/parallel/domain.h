/* domain.h - which rank owns which part of the region, by orthogonal recursive bisection; migration
 * of particles and of other things that have a position; ghosts: the halo of other ranks and
 * periodic images. Collective over s->run->comm where no other is said. Finer levels share the cuts
 * of the coarsest.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

struct domain;

/* The partition of level s, for a uniform filling; owned by the caller (FREE). Sets
 * s->domain. */
struct domain *domain_create(struct sph *s);
/* Cuts the region anew so that all ranks have the same work, if the imbalance max/mean - 1 is above
 * `tolerance'; returns whether it did, and then domain_migrate is due. Work is pairs in the list
 * plus a constant per particle, or the number of particles where the list is not of the present
 * state. */
bool domain_balance(struct sph *s, double tolerance);
/* Takes over a region that has moved (s->lo, s->hi). The cuts stay until the work asks for
 * others. */
void domain_follow(struct sph *s);
/* Parallel efficiency: mean over largest work of a rank, averaged over the times when it was
 * measured, each before the cuts were made anew; 1 on one rank. Local. */
double domain_tau(const struct domain *d);
/* Rank that owns the point x, also where x is outside of the region. Local. */
int domain_owner(const struct domain *d, const double *x);
/* Box of this rank's part, m. Local. */
void domain_bounds(const struct domain *d, double lo[3], double hi[3]);
/* Wraps periodic positions and sends particles to their owners. Ghosts are gone afterwards. */
void domain_migrate(struct sph *s);
/* Makes the ghosts, all particles and images within R + skin of this rank's part, and fills their
 * prim. */
void domain_ghosts(struct sph *s);
/* Refresh prim (positions shifted for images) or slope of the ghosts. Start and finish are apart so
 * that rows without ghosts can be computed between them. */
void domain_halo_start(struct sph *s, bool slopes);
void domain_halo_finish(struct sph *s, bool slopes);
/* Sends one record of `width' doubles per local to its ghosts, in the order of these
 * (ghosts[nhalo][width]); ghosts of walls and open sides get none. */
void domain_share(struct sph *s, const double *rows, int width, double *ghosts);
/* The cuts in the restart file, after the particles, so that a run continues bit for bit. On
 * another number of ranks domain_load makes new ones from the particles. false: the file has no
 * cuts. */
void domain_save(const struct sph *s, struct h5 *f);
bool domain_load(struct sph *s, struct h5 *f);
