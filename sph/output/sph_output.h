/* sph_output.h - snapshots, restart files, rows of the series, the summary; the functions of struct
 * program that write. All are collective.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* row, snapshot and checkpoint of struct program; s is a struct sph *, of the coarsest level. */
void sph_row(void *s, struct figures *to);
void sph_snapshot(void *s, struct h5 *f, struct xdmf *x, const char *file);
void sph_checkpoint(void *s, struct h5 *f);
/* Reads what sph_checkpoint wrote; false: it does not fit, and the reason has been logged. */
bool sph_restore(struct sph *s, struct h5 *f);
/* finish of struct program. */
void sph_finish(void *s);
/* Sums over the free zone for the coupler: `tell' of struct program. */
void sph_tell(void *s, struct summary *report);
/* sph_lines.c: extrema of velocity on the centre lines into the summary; 2D. */
void sph_summarise_extrema(const struct sph *s);
