/* moved_box.h - a partner's box that has moved: other cells are imposed. Those that come free start
 * from the partner's velocity, which they had, and from the pressure continued from the free side;
 * those that become imposed have a past of their own. Blocks are cut anew around the box.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MOVED_BOX_H
#define FV_MOVED_BOX_H

#include "../fv.h"

/* Before the first lists are made: room for what cells had, and on blocks the first cut. */
void moved_box_prepare(struct fv *s, const double (*box)[2][3]);
/* Forces the cells of these n boxes instead of those before; false: they are the same. why: gets
 * what is wrong with that place, "": nothing. Collective. */
bool moved_box(struct fv *s, int n, const double (*box)[2][3], char why[256]);
/* The matrix and the bounds of the viscous terms, for s->forcing as it is. Collective. */
void moved_box_renew(struct fv *s);

#endif
