/* forced_restart.h - a partner's velocities at three times in a restart file, by the numbers of
 * their cells, so that other ranks find them. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FORCED_RESTART_H
#define FV_FORCED_RESTART_H

#include "../fv.h"

/* Of s->forcing, both ways. Collective. false: the file has none that fit. */
bool forced_restart(const struct fv *s, struct h5 *f);

#endif
