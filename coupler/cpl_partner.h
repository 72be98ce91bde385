/* cpl_partner.h - cpl.h behind the struct partner that common/run/run.h takes; shared by sph and
 * fv.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../common/run/run.h"
#include "cpl.h"

/* The only partner there is; its ctx is a struct cpl *. */
extern const struct partner cpl_partner;

/* Of calls of cpl.h that only a partner or the input can make fail: ends the job with the library's
 * message; any other error is a mistake of this program. */
static inline void partner_check(struct cpl *c, int code)
{
    if (code == CPL_EPARTNER || code == CPL_EINPUT) {
        signals_handled(); /* cpl_fail says it */
        cpl_fail(c, RUN_PARTNER, cpl_strerror(c));
    }
    if (code)
        abort_run("coupling: %s", cpl_strerror(c));
}
