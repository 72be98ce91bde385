/* sph_coupling.h - a run of particles within a coupled job.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_COUPLING_H
#define SPH_COUPLING_H

#include "../sph.h"

/* coupling_check.c: what a coupled job cannot be. */
void coupling_check(const struct run *r, const struct sph_params *prm, struct faults *f);
/* coupling_check.c: whether what sph gives reaches from wall to wall and cuts fv's flow in two
 * along axis a. Whether fv's flow beyond end `end' of the box (2 a: below, 2 a + 1: above) has an
 * outlet, which sets its pressure. */
bool coupling_cuts(const struct run *r, const struct sph_params *prm, int a);
bool coupling_has_outlet(const struct run *r, int end);
/* coupling_solids.c: of what is allowed, and better otherwise. */
void coupling_warn(const struct run *r, const struct sph_params *prm);
/* Publishes sph.box and sph.free. */
void coupling_offer(struct run *r, const struct sph_params *prm);
/* Declares sets and fields; s->zones->eval reads the patch. */
void sph_coupling_create(struct sph *s);
void sph_coupling_free(struct sph *s);
void sph_coupling_window_begin(void *s, double t0, double t1);
void sph_coupling_window_end(void *s, double t1);

#endif
