/* halving.h - one multigrid cycle for the pressure under a free surface on uniform cells and
 * layers, whose matrix is another one in each step. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../grid/fv_grid.h"

/* Whether the grid has no period, and so few ranks share it that each may have all coarser levels.
 */
bool halving_fits(const struct block *b);
/* The levels over the whole grid; owned by the caller (FREE), b is borrowed. */
struct halving *halving_create(const struct block *b);
/* Ahead of halving_set_matrix: nothing has a row. */
void halving_begin(struct halving *h);
/* What is to be set then. Fields: what the lower face of a cell along axis a passes, 1/m^2, also of
 * the first ghosts beyond the last cells; what the diagonal has beside its faces. Both are 0 where
 * no row is. */
double *halving_through(struct halving *h, int a);
double *halving_own(struct halving *h);
/* Of the line of cells (j, k): the first cell and the number of those among which its rows are. */
int *halving_run(struct halving *h, int j, int k);
/* Makes the coarser levels. Collective over b->cart, as halving_cycle. */
void halving_set_matrix(struct halving *h);
/* x = one cycle on r, a linear and symmetric map; both are 0 where no row is. */
void halving_cycle(struct halving *h, double *r, double *x);
