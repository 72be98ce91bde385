/* cpl_partner.h - cpl.h behind the struct partner that common/run/run.h takes; shared by sph and
 * fv.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_CPL_PARTNER_H
#define COUPLER_CPL_PARTNER_H

#include "../common/run/run.h"

/* The only partner there is; its ctx is a struct cpl *. */
extern const struct partner cpl_partner;

#endif
