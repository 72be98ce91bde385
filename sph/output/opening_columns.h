/* opening_columns.h - what passes inlets, outlets and sides where water falls out, in series and
 * summary: mass through each of them, and the level of the water outside.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* Adds its columns of series.csv. Collective, as opening_summary. */
void opening_row(const struct sph *s, struct figures *to);
void opening_summary(const struct sph *s, struct summary *to);
