/* counts.h - as many guards as there are particles that flow beside them. Both generations are
 * moved apart by what bounds and shifts each; guards near the outer edge stray out while no parent
 * enters. Where children are missing beside parents that flow some are born, where there are too
 * many some die. None of them flows, so that this makes no mass; what it keeps is the mass that
 * wakes where as much goes to sleep. The number of parents is left alone: that of the coarsest
 * level is what keeps the mass in the end. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_COUNTS_H
#define SPH_COUNTS_H

#include "../sph.h"

/* After guards_list, every few steps, of s and all finer levels: who is to be born
 * (guards.newborn), and guards that are to die (ROLE_SURPLUS) at the end of the step. Collective.
 */
void counts_mark(struct sph *s);

#endif
