/* sph_link.h - a run of particles within a coupled job: the functions of struct program for it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_LINK_H
#define SPH_LINK_H

#include "../sph.h"

/* coupling_check.c: adds faults for what a coupled job cannot do. */
void coupling_check(const struct run *r, const struct sph_params *prm, struct faults *f);
/* coupling_check.c: whether what sph gives reaches from wall to wall and cuts fv's flow in two
 * along axis a. Whether fv's flow beyond end `end' of the box (2 a: below, 2 a + 1: above) has an
 * outlet, which sets its pressure. */
bool coupling_cuts(const struct run *r, const struct sph_params *prm, int a);
bool coupling_has_outlet(const struct run *r, int end);
/* coupling_solids.c: warns of what is allowed but better done otherwise. */
void coupling_warn(const struct run *r, const struct sph_params *prm);
/* Publishes sph.box and sph.free to the partners (cpl_zone). Collective. */
void coupling_offer(struct run *r, const struct sph_params *prm);
/* Declares sets and fields, and makes s->zones->eval read the patch. Collective. */
void sph_coupling_create(struct sph *s);
/* Before the first and after the last step of the coupling step [t0, t1], s: takes patches, puts
 * particles. Collective. */
void sph_coupling_window_begin(void *s, double t0, double t1);
void sph_coupling_window_end(void *s, double t1);

#endif
