/* coupling_check.c - scenes that a coupled job cannot do, found before it starts.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_params.h"
#include "windows.h"
#include "zones.h"

void coupling_check(const struct run *r, struct faults *f)
{
    const struct sph_params *prm = sph_params_of(r);
    windows_check(r, prm, f);
}
