/* moved_box.h - a partner's box that has moved: other cells are forced. Those that come free start
 * from the partner's velocity, which they had, and from the pressure continued from the free side;
 * those that become forced have a past of their own.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MOVED_BOX_H
#define FV_MOVED_BOX_H

#include "fv_course.h"

/* Forces the cells of these n boxes instead of those before, if they are others; false: they are
 * the same. c: the velocities of the last windows. Collective. */
bool moved_box(struct fv *s, const struct course *c, int n, const double (*box)[2][3]);

#endif
