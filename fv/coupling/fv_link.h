/* fv_link.h - a partner in the same job.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_LINK_H
#define FV_LINK_H

#include "../fv.h"

/* fv_coupling.c: the only file here that knows cpl.h. */
/* Meets the partners (s->partners.n): the boxes whose cells they give. Before the blocks are made.
 */
void coupling_boxes(struct fv *s, double box[PARTNERS_MAX][2][3]);
/* Ends the job: for want of something that this reason says. */
void coupling_refuse(const struct fv *s, const char *reason);
/* Lists of what is given, both ways; fields of the start must be there. */
void fv_coupling_create(struct fv *s);
void fv_coupling_free(struct fv *s);
/* Fills d where the partner has left out too many cells; share of them; worst one. */
void coupling_judge(struct fv *s, struct diagnosis *d);
double coupling_unmapped(const struct fv *s);
/* m^dim that both programs have lost since the start. */
double coupling_water_missing(const struct fv *s);
void coupling_summary(const struct fv *s, struct summary *to);
/* s: the longest coupling step that suits FV. */
double coupling_longest_window(void *s);
void coupling_first(void *s);
void fv_coupling_window_begin(void *s, double t0, double t1);
void fv_coupling_window_end(void *s, double t1);
/* Before the fields of a restart file are read: a partner's box that moves stands as it did. */
bool coupling_stand(struct fv *s, struct h5 *f);
void coupling_save(const struct fv *s, struct h5 *f);
bool coupling_load(struct fv *s, struct h5 *f);

#endif
