/* cell_places.h - where a cell is, on any kind of grid, by its place in the fields.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_CELL_PLACES_H
#define FV_CELL_PLACES_H

#include "../fv.h"

/* m: centre of the cell at place c. */
void cell_centre(const struct fv *s, int64_t c, double *x);
/* Its number in the whole grid, or among the cells of all blocks. */
int64_t cell_number(const struct fv *s, int64_t c);

#endif
