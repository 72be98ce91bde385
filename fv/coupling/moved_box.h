/* moved_box.h - a partner's box that has moved: other cells are forced. Those that come free start
 * from the partner's velocity, which they had, and from the pressure continued from the free side;
 * those that become forced have a past of their own.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MOVED_BOX_H
#define FV_MOVED_BOX_H

#include "../fv.h"

enum moved { MOVED_NOT, MOVED, MOVED_LOST };

/* Forces the cells of these n boxes instead of those before, if they are others; lost: no cell lies
 * wholly in one, and nothing has changed. Collective. */
enum moved moved_box(struct fv *s, int n, const double (*box)[2][3]);

#endif
