/* domain.h - which rank owns which part of the region: orthogonal recursive bisection, migration of
 * particles (and of other things that have a place), ghosts: halo of other ranks and periodic
 * images. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_DOMAIN_H
#define SPH_DOMAIN_H

#include "../sph.h"

struct domain;

struct domain *domain_create(struct sph *s); /* collective over s->run->comm */
void domain_free(struct domain **d);
/* Cuts the region anew so that every rank has the same work, if the imbalance is above `tolerance'
 * (max/mean - 1); returns whether it did. Then domain_migrate is due. Work: pairs in the list and a
 * constant, or particles where the list is not of the present state. */
bool domain_balance(struct sph *s, double tolerance);
/* The region has moved: s->lo, s->hi. The cuts stay until the work wants others. */
void domain_follow(struct sph *s);
/* Work of a rank, mean over largest, on average over the times when it was looked at, each before
 * the cuts were made anew; 1 on one rank. */
double domain_tau(const struct domain *d);
/* Rank that owns the place x (clamped into the region). */
int domain_owner(const struct domain *d, const double *x);
/* Bounds of this rank's part. */
void domain_bounds(const struct domain *d, double lo[3], double hi[3]);
/* Wraps periodic positions and sends particles to their owners. Ghosts are gone afterwards. */
void domain_migrate(struct sph *s);
/* Sends items (rows of `width' doubles, place in the first dim of them) to the owners of their
 * places; returns the new number; *items is reallocated (mem_grow). Order: by sending rank, then as
 * they were. */
int domain_send_items(struct sph *s, double **items, int n, int width);
/* Makes the ghosts: places within R + skin of this rank's part; fills prim of the ghosts. */
void domain_ghosts(struct sph *s);
/* Refreshes prim (positions shifted for images) or slope of the ghosts, start and finish apart so
 * that interior work can run between. */
void domain_halo_start(struct sph *s, bool slopes);
void domain_halo_finish(struct sph *s, bool slopes);
/* Rows of `width' doubles of the locals to their ghosts, in the order of these; those of walls and
 * openings get none. Collective. */
void domain_share(struct sph *s, const double *rows, int width, double *ghosts);
/* Bit-for-bit restart: the cuts; after the particles. On another number of ranks new ones. */
void domain_save(const struct sph *s, struct h5 *f);
bool domain_load(struct sph *s, struct h5 *f);

#endif
