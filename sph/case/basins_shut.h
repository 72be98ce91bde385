/* basins_shut.h - waters of the start that nothing but walls and bodies bounds.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdint.h>

struct basins;
/* Finds them, and sets the levels of those in which water seeps. */
void basins_find_shut(struct basins *b);
/* Whether there is but one water, and nothing but walls and bodies bounds it. */
bool basins_all_shut(struct basins *b);
/* Number of cells of the k-th water that nothing but walls and bodies bounds, with these (see
 * shut_water.h) and its middle, m; 0: there are no more. Their cells, ascending, into cell[]. */
int64_t basins_shut_in(struct basins *b, int k, unsigned *beside, double *where);
void basins_cells_shut_in(struct basins *b, int k, int64_t *cell);
