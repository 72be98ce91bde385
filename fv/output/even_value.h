/* even_value.h - values of fields at a place in uniform cells or layers.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../fv.h"

/* Whether no fluid is in a local cell: it is in a box or behind a closed side. */
bool even_is_solid(const struct fv *s, const int *at);
/* The cell that x lies in, of those about it (i, w as below): more than half a cell away from the
 * lower centre it is the upper one, on a face between them one that holds fluid, else one in no
 * box, whichever way the axes run. */
void even_host(const struct fv *s, const int *i, const double *w, int host[3]);
/* Value at x of averages q (NULL: the pressure), with ghosts, by a polynomial through three or four
 * cells each way that hold fluid. i, w: the lower ones of the cells whose centres are around x, and
 * how far x is from theirs towards the next, in steps. false: there are not so many. */
bool even_value(const struct fv *s, const double *q, const double *x, const int *i, const double *w,
                double *value);
