/* report.h - errors and energies in the series and in the summary.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../fv.h"

/* Error norms: of velocity, pressure and vorticity. */
enum { NORMS = 3 };

/* fv_errors.c: kinetic energy over the computed cells by averages, the exact field's, and what
 * velocities within cells add to the first, J/kg m^dim. */
void fv_energies(struct fv *s, double sum[3]);
/* Errors against the exact field now, of all ranks, in the fields' own units. Collective. */
void fv_errors(struct fv *s, struct norm n[NORMS]);
/* How the run steps: "rk3, three projections a step". */
const char *report_method(const struct fv_params *prm);
