/* opening_columns.h - what passes inlets, outlets and sides where water falls out, in series and
 * summary: mass through each of them, and the level of the water outside.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_OPENING_COLUMNS_H
#define SPH_OPENING_COLUMNS_H

#include "../sph.h"

/* Appends the headings of its columns of series.csv to names; returns their number. */
int opening_columns(const struct run *r, const struct sph_params *prm, const char **names);
/* Writes the values of these columns; returns the end of them. Collective, as opening_summary. */
double *opening_row(const struct sph *s, double *values);
void opening_summary(const struct sph *s, struct summary *to);

#endif
