/* rows.h - rows of cells of unequal height along y: even ones at the top, where a partner or a
 * surface needs them, growing ones below. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_ROWS_H
#define FV_ROWS_H

#include "block.h"

enum {
    ROWS_BOTTOM = 4, /* rows at the bottom that are as high as the lowest: one-sided forms there are
                        those of even cells */
    ROWS_GROWING = 4 /* at least, between them and the even ones */
};

/* Heights of n rows, from the lowest on, over the `length' of the domain: the upper `even' ones
 * share what is above `above' (m from the bottom), the others grow downwards by a smooth step of
 * the logarithm. Returns the largest ratio of two neighbours; NAN: no heights do that, h is not
 * set. */
double rows_heights(int n, int even, double above, double length, double *h);

/* Gives b rows of these heights, n = b->cells[1] of them; b->h[1] is the height of the even ones
 * then. */
void rows_create(struct block *b, int even, const double *h);
void rows_free(struct rows **r);

#endif
