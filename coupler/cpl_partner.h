/* cpl_partner.h - cpl.h as the struct partner that common/run.h takes: shared by sph and fv.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_CPL_PARTNER_H
#define COUPLER_CPL_PARTNER_H

#include "../common/run/run.h"

extern const struct partner cpl_partner; /* ctx is a struct cpl * */

#endif
