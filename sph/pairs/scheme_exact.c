/* scheme_exact.c - the second pass of Riemann SPH with exact Riemann problems, for comparison: the
 * instances of riemann_rows.h that scheme_rates.c does not have, so that it pays nothing for them.
 * A Riemann problem takes up to 20 Newton steps (riemann_exact.h), hence for tests and comparisons
 * alone. EXACT must be defined before EACH(DEFINE), which reads it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scheme.h"

#include "riemann_rows.h"

enum { EXACT = true };

EACH(DEFINE)

scheme_pass *scheme_exact_rates(int dim, int scheme, int viscosity)
{
    static scheme_pass *const passes[2][2][3] = {EACH(ENTRY)};
    return passes[dim - 2][scheme][viscosity];
}
