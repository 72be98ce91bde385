/* opening_columns.h - what passes inlets, outlets and sides where water falls out, in series and
 * summary: mass through each of them, and the level of the water outside.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_OPENING_COLUMNS_H
#define SPH_OPENING_COLUMNS_H

#include "../sph.h"

int opening_columns(const struct run *r, const struct sph_params *prm, const char **names);
/* Collective, as the next; returns the place behind the last value. */
double *opening_row(const struct sph *s, double *values);
void opening_summary(const struct sph *s, struct summary *to);

#endif
