/* fv_link.h - exchange with the programs of particles in the same job: what the main program, the
 * state and the steps call. All calls are collective over s->comm and, but for coupling_boxes, want
 * s->link. Calls of the coupling library that fail end the run, since a partner has.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_LINK_H
#define FV_LINK_H

#include "../fv.h"

/* fv_coupling.c, the only file here that knows cpl.h: makes s->link, asks the partners for their
 * zones and sets s->partners.n and box[n], lower and upper corner, m: what lies in them is theirs.
 * Before the mesh is made, which is cut around them. */
void coupling_boxes(struct fv *s, double box[PARTNERS_MAX][2][3]);
/* Ends the job with this reason, on all programs. */
void coupling_refuse(const struct fv *s, const char *reason);
/* Makes s->forcing and the lists of cells whose values go to partners and come from them. The
 * fields of the start must be there. */
void fv_coupling_create(struct fv *s);
/* Sets d where partners have given no values to too large a share of the imposed cells, or where a
 * box has moved to where cells have no donors. */
void coupling_judge(struct fv *s, struct diagnosis *d);
/* That share of the imposed cells, -, at the last exchange. */
double coupling_unmapped(const struct fv *s);
/* Volume of water, m^dim, that both programs have lost since the start without account. */
double coupling_water_missing(const struct fv *s);
/* Adds the worst values of both to the summary. */
void coupling_summary(const struct fv *s, struct summary *to);

/* The next four are functions of struct program; s is a struct fv. The longest coupling step that
 * suits this program, s. */
double coupling_longest_window(void *s);
/* Declares the places of what is exchanged and sends the first fields. */
void coupling_first(void *s);
/* The coupling step from t0 to t1, s, begins: sends fields of a trial step to t1, receives the
 * partners' values at t1; imposed cells that got none keep theirs. */
void fv_coupling_window_begin(void *s, double t0, double t1);
/* It is done: takes the course of the fields over it, the pressure that partners differ by and the
 * balance of water. */
void fv_coupling_window_end(void *s, double t1);

/* Before the fields of a restart file are read: puts boxes that move where they stood. false: the
 * file does not have them. */
bool coupling_stand(struct fv *s, struct h5 *f);
/* Writes what the exchange needs from coupling step to coupling step to a restart file, or reads it
 * back; false: the file does not have it. */
bool coupling_restart(struct fv *s, struct h5 *f);

#endif
